// SPDX-License-Identifier: Apache-2.0
// Tables with values that no surface has, compressed, decoded and evaluated.
#include "extremes/one_basis_file.h"
#include "support/direction_batch.h"
#include "support/numeric_bound.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>
#include <brdf/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace brdf::test {
namespace {

const char* const group = "Tables";
NumericBound sound(group, "decoded at every level: values that are not finite or negative", "count", 0);
NumericBound not_numbers(group, "NaN or Inf in a valid cell: tables that are not refused as such", "count", 0);
NumericBound too_small(group, "tables below 2x2x2 cells that are not refused as such", "count", 0);
NumericBound promised(group, "log_mae measured again over the recorded one", "ratio", 1);
NumericBound promised_psnr(group, "psnr_env recorded above the one measured again", "dB", 0);
NumericBound refused(group, "tables without any measured value that are not refused", "count", 0);

struct TableCase {
  std::string name;
  Measurement measurement;
};

using Spoil = std::function<void(HalfDifferenceTable&, std::size_t channels)>;

/// Value of cell `i`; invalid cells keep theirs.
Spoil every_cell(std::function<float(std::size_t)> value) {
  return [value](HalfDifferenceTable& t, std::size_t channels) {
    for (std::size_t i = 0; i < t.values.size(); ++i) t.values[i] = value(i / channels);
  };
}

std::size_t valid_cell(const HalfDifferenceTable& t, std::size_t after) {
  return static_cast<std::size_t>(std::find(t.valid.begin() + static_cast<std::ptrdiff_t>(after), t.valid.end(), 1) - t.valid.begin());
}

/// As readers leave a cell that is no number: masked, with the value in place.
Spoil one_masked(float value) {
  return [value](HalfDifferenceTable& t, std::size_t channels) {
    const std::size_t cell = valid_cell(t, t.valid.size() / 3);
    t.values[cell * channels] = value;
    t.valid[cell] = 0;
  };
}

void mask_band(HalfDifferenceTable& t, std::size_t) {
  const auto row = static_cast<std::size_t>(t.n_theta_d * t.n_phi_d);
  for (std::size_t i = 0; i < t.valid.size(); ++i)
    if (i / row >= 4 && i / row < 8) t.valid[i] = 0;
}

void spike_beside_holes(HalfDifferenceTable& t, std::size_t channels) {
  const std::size_t cell = valid_cell(t, 20);
  for (std::size_t c = 0; c < channels; ++c) t.values[cell * channels + c] = 1e6F;
  for (const std::size_t other : {cell - 1, cell + 1, cell + static_cast<std::size_t>(t.n_phi_d)}) t.valid[other] = 0;
}

std::vector<TableCase> cases() {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<std::string, Spoil>> spoils = {
      {"all zero", every_cell([](std::size_t) { return 0.0F; })},
      {"constant", every_cell([](std::size_t) { return 0.25F; })},
      {"1e-30", every_cell([](std::size_t) { return 1e-30F; })},
      {"1e30", every_cell([](std::size_t) { return 1e30F; })},
      {"denormal", every_cell([](std::size_t) { return 1e-42F; })},
      {"one cell not zero", [](HalfDifferenceTable& t, std::size_t n) {
         std::fill(t.values.begin(), t.values.end(), 0.0F);
         t.values[valid_cell(t, 30) * n] = 5;
       }},
      {"alternating noise", every_cell([](std::size_t i) { return i % 2 == 0 ? 1e-4F : 10.0F; })},
      {"1e-30 beside 1e30", every_cell([](std::size_t i) { return i % 3 == 0 ? 1e30F : 1e-30F; })},
      {"one NaN, masked", one_masked(nan)},
      {"one Inf, masked", one_masked(inf)},
      {"one band masked", mask_band},
      {"a spike next to invalid cells", spike_beside_holes}};
  std::vector<TableCase> all;
  for (const int channels : {1, 3})
    for (const auto& [name, spoil] : spoils) {
      TableCase c{name + ", " + std::to_string(channels) + " channels", bumpy_measurement({12, 6, 8}, channels)};
      spoil(std::get<HalfDifferenceTable>(c.measurement.table), static_cast<std::size_t>(channels));
      all.push_back(std::move(c));
    }
  for (const TableShape& s : {TableShape{2, 2, 2}, TableShape{3, 5, 7}, TableShape{13, 2, 9}, TableShape{2, 9, 3}, TableShape{5, 3, 11, true}})
    all.push_back({std::to_string(s.n_theta_h) + "x" + std::to_string(s.n_theta_d) + "x" + std::to_string(s.n_phi_d), bumpy_measurement(s)});
  return all;
}

void expect_sound(const TableCase& c, std::span<const std::byte> bytes) {
  static double count = 0;
  const DirectionBatch wi = random_directions(300, 51), wo = random_directions(300, 52);
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    DecodeOptions options;
    options.level = level;
    const Material m = Material::decode(bytes, options);
    std::vector<float> f(static_cast<std::size_t>(m.channels()) * wi.size());
    m.eval(wi.span(), wo.span(), {f.data(), wi.size()});
    for (const float v : f) {
      count += std::isfinite(v) && v >= 0 ? 0 : 1;
      sound.see(count, [&] { return c.name + ", " + to_string(level); });
    }
  }
}

void expect_kept_promises(const TableCase& c) {
  SCOPED_TRACE(c.name);
  EncodeOptions options;
  options.effort = 0;
  options.target_size = 400 + 40 * static_cast<std::uint64_t>(c.measurement.channels.count);
  const EncodeResult r = compress(c.measurement, options);
  ASSERT_LE(r.bytes.size(), *options.target_size);
  expect_sound(c, r.bytes);
  const RecordedError recorded = [&] {
    for (const RecordedError& e : r.summary.errors)
      if (e.refinement == r.summary.refinements && (e.level == options.level || r.summary.refinements == 0)) return e;
    return RecordedError{};
  }();
  // the same queries as the encoder's
  const encode::Verification again(c.measurement, encode::effort_step(0).verify_quality, 1);
  const ErrorReport report = again.score(r.bytes, r.summary.refinements == 0 ? EvalLevel::fast : options.level);
  const double largest_code = 3.6;  // larger ones are not recorded
  if (recorded.log_mae < largest_code)
    promised.see(report.log_mae.all == 0 ? 0 : report.log_mae.all / recorded.log_mae, [&] { return c.name; });
  promised_psnr.see(std::max(recorded.psnr_env - report.psnr_env, 0.0), [&] { return c.name; });
}

TEST(Tables, OddValuesAndSizesGiveSoundFiles) {
  for (const TableCase& c : cases()) expect_kept_promises(c);
  sound.check();
  promised.check();
  promised_psnr.check();
}

TEST(Tables, ManyChannels) {
  TableCase noise{"alternating noise, 31 channels", bumpy_measurement({8, 4, 6}, 31)};
  auto& values = std::get<HalfDifferenceTable>(noise.measurement.table).values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i / 31 % 2 == 0 ? 1e-4F : 10.0F;
  TableCase band{"one band masked, 195 channels", bumpy_measurement({9, 4, 5}, 195)};
  mask_band(std::get<HalfDifferenceTable>(band.measurement.table), 195);
  for (const TableCase& c : {noise, band}) {
    const int channels = c.measurement.channels.count;
    // the search of compress() takes too long with so many
    const encode::Verification verification(c.measurement, 0.002, 1);
    const LobeSet lobes{channels, {{LobeKind::lambert, 1, 1, std::vector<double>(static_cast<std::size_t>(channels), 0.2)}}};
    const auto content = one_basis_content(c.measurement, lobes, verification, residual::Azimuth::symmetric, 60);
    ASSERT_FALSE(content.residual.empty());
    const std::vector<std::byte> bytes = container::pack(content);
    expect_sound(c, bytes);
    promised.see(verification.score(bytes, EvalLevel::balanced).log_mae.all / Material::decode(bytes).info().errors[1].log_mae, [&] { return c.name; });
  }
  sound.check();
  promised.check();
}

TEST(Tables, FewerThanTwoNodesOnAnAxisAreRefused) {
  double count = 0;
  for (const TableShape& s : {TableShape{1, 1, 1}, TableShape{1, 2, 3}, TableShape{13, 1, 9}, TableShape{2, 9, 1}}) {
    EncodeOptions options;
    options.effort = 0;
    try {
      compress(bumpy_measurement(s), options);
      ++count;
    } catch (const Error& e) {
      count += e.code() == ErrorCode::invalid_argument ? 0 : 1;
    }
    too_small.see(count, [&] { return std::to_string(s.n_theta_h) + "x" + std::to_string(s.n_theta_d) + "x" + std::to_string(s.n_phi_d); });
  }
  too_small.check();
}

TEST(Tables, ValidCellsThatAreNoNumbersAreRefused) {
  double count = 0;
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Measurement m = bumpy_measurement({12, 6, 8});
    auto& t = std::get<HalfDifferenceTable>(m.table);
    t.values[3 * valid_cell(t, 40) + 1] = value;
    try {
      compress(m);
      ++count;
    } catch (const Error& e) {
      count += e.code() == ErrorCode::invalid_argument && std::string(e.what()).find("is not finite") != std::string::npos ? 0 : 1;
    }
    not_numbers.see(count, [&] { return numbers({static_cast<double>(value)}); });
  }
  not_numbers.check();
}

TEST(Tables, WhatHoldsNothingIsRefused) {
  double count = 0;
  for (const int channels : {1, 3, 31}) {
    Measurement m = bumpy_measurement({8, 4, 6}, channels);
    auto& t = std::get<HalfDifferenceTable>(m.table);
    std::fill(t.valid.begin(), t.valid.end(), std::uint8_t{0});
    EncodeOptions options;
    options.effort = 0;
    try {
      compress(m, options);
      ++count;
    } catch (const Error& e) {
      if (e.code() != ErrorCode::no_data) ++count;
    }
    refused.see(count, [&] { return std::to_string(channels) + " channels, all masked"; });
  }
  refused.check();
}

}  // namespace
}  // namespace brdf::test
