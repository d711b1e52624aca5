// SPDX-License-Identifier: Apache-2.0
// Analytic models and analytic chunks that mean nothing: wrong calls, and files whose checksums are right.
#include "support/analytic_models.h"
#include "support/brdfc_content.h"
#include "support/brdfc_parts.h"
#include "support/expect_error.h"

#include <brdf/check.h>
#include <brdf/encode.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace brdf {
namespace {

using test::expect_error;
using test::FileParts;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

struct Wrong {
  AnalyticModel model;
  const char* field;
};

std::vector<Wrong> wrong_models() {
  std::vector<Wrong> all{{Lambert{{}}, "channels"},
                         {Mirror{std::vector<float>(1025, 0.5f)}, "channels"},
                         {GgxReflector{0.1f, 0.1f, {}}, "channels"},
                         {GgxReflector{0.1f, 0.2f, {1}, true}, "multiple scattering"},
                         {Dielectric{1.5f, 0}, "channels"},
                         {Dielectric{1.5f, 1025}, "channels"}};
  for (const float v : {-1e-30f, std::nextafter(1.0f, 2.0f), nan, infinity, -infinity}) {
    all.push_back({Lambert{{0.5f, v, 0.5f}}, "albedo of channel 1"});
    all.push_back({Mirror{{v}}, "reflectance of channel 0"});
    all.push_back({GgxReflector{0.1f, 0.1f, {0.5f, 0.5f, v}}, "f0 of channel 2"});
  }
  for (const float v : {0.0f, 0.99e-4f, 1.01f, -0.1f, nan, infinity}) {
    all.push_back({GgxReflector{v, 0.1f, {1}}, "alpha_x"});
    all.push_back({GgxReflector{0.1f, v, {1}}, "alpha_y"});
  }
  for (const float v : {0.0f, 0.09f, 10.1f, -1.5f, nan, infinity}) all.push_back({Dielectric{v, 3}, "ior"});
  return all;
}

TEST(AnalyticFields, WrongModelsAreNamed) {
  for (const Wrong& wrong : wrong_models()) {
    expect_error(ErrorCode::invalid_argument, {wrong.field, "allowed"}, [&] { (void)Material::from_analytic(wrong.model); });
    expect_error(ErrorCode::invalid_argument, {wrong.field, "allowed"}, [&] { (void)pack_analytic(wrong.model); });
  }
}

TEST(AnalyticFields, ChannelsMustBeDescribed) {
  const GgxReflector five{0.1f, 0.1f, {1, 1, 1, 1, 1}};
  expect_error(ErrorCode::invalid_argument, {"5 channels", "wavelengths"}, [&] { (void)pack_analytic(five); });
  Channels described{ChannelModel::spectral, 4, {400, 500, 600, 700}};
  expect_error(ErrorCode::invalid_argument, {"5 channels", "4 are described"}, [&] { (void)pack_analytic(five, nullptr, &described); });
  described = {ChannelModel::spectral, 5, {400, 500, 600, 700, 700}};
  expect_error(ErrorCode::invalid_argument, {"ascending"}, [&] { (void)pack_analytic(five, nullptr, &described); });
  for (const float last : {1e7f, infinity, nan}) {
    described.wavelengths_nm.back() = last;
    expect_error(ErrorCode::invalid_argument, {"wavelengths"}, [&] { (void)pack_analytic(five, nullptr, &described); });
  }
  described.wavelengths_nm.back() = 800;
  EXPECT_EQ(Material::decode(pack_analytic(five, nullptr, &described)).info().channels.wavelengths_nm, described.wavelengths_nm);
}

/// decode and check_file refuse the parts for the same reason.
void expect_refused(const FileParts& parts, ErrorCode code, std::initializer_list<const char*> words) {
  const auto bytes = parts.build();
  expect_error(code, words, [&] { (void)Material::decode(bytes); });
  const FileCheck check = check_file(bytes);
  ASSERT_TRUE(check.problem);
  EXPECT_EQ(check.problem->code(), code) << check.problem->what();
}

FileParts parts_of(const AnalyticModel& model) { return test::parts_of(pack_analytic(model)); }

std::vector<std::byte>& payload(FileParts& p) { return p.chunks[0].payload; }

void set_float(FileParts& p, std::size_t index, float v) {
  base::store_little_endian(v, std::span(payload(p)).subspan(1 + 4 * index, 4));
}

TEST(AnalyticFields, ValuesOutOfRangeAreMalformed) {
  for (const float v : {-0.1f, 1.1f, nan, infinity}) {
    FileParts p = parts_of(Lambert{{0.5f, 0.5f, 0.5f}});
    set_float(p, 2, v);
    expect_refused(p, ErrorCode::malformed, {"analytic chunk", "albedo of channel 2"});
    p = parts_of(Mirror{{0.5f}});
    set_float(p, 0, v);
    expect_refused(p, ErrorCode::malformed, {"analytic chunk", "reflectance"});
    p = parts_of(GgxReflector{0.1f, 0.2f, {0.5f}});
    set_float(p, 2, v);
    expect_refused(p, ErrorCode::malformed, {"analytic chunk", "f0"});
  }
  for (const float v : {0.0f, 0.99e-4f, 1.1f, nan, infinity})
    for (const std::size_t axis : {0U, 1U}) {
      FileParts p = parts_of(GgxReflector{0.1f, 0.2f, {0.5f}});
      set_float(p, axis, v);
      expect_refused(p, ErrorCode::malformed, {"analytic chunk", axis == 0 ? "alpha_x" : "alpha_y"});
    }
  FileParts p = parts_of(GgxReflector{0.1f, 0.2f, {0.5f}});
  set_float(p, 1, 0.1f);
  expect_refused(p, ErrorCode::malformed, {"two roughnesses that are the same"});
  for (const float v : {0.0f, -1.5f, 0.09f, 10.1f, nan, infinity}) {
    p = parts_of(Dielectric{1.5f, 3});
    set_float(p, 0, v);
    expect_refused(p, ErrorCode::malformed, {"analytic chunk", "ior"});
  }
}

TEST(AnalyticFields, KindsAndReservedBits) {
  for (unsigned kind = 4; kind < 16; ++kind) {
    FileParts p = parts_of(Lambert{{0.5f}});
    payload(p)[0] = static_cast<std::byte>(kind);
    expect_refused(p, ErrorCode::unsupported, {"kind", std::to_string(kind).c_str()});
  }
  for (const AnalyticModel& model : {AnalyticModel(Lambert{{0.5f}}), AnalyticModel(GgxReflector{0.1f, 0.1f, {1}}),
                                     AnalyticModel(Mirror{{0.5f}}), AnalyticModel(Dielectric{1.5f, 1})})
    for (const unsigned bit : {0x10U, 0x20U, 0x40U, 0x80U}) {
      if (std::holds_alternative<GgxReflector>(model) && bit < 0x40U) continue;
      FileParts p = parts_of(model);
      payload(p)[0] |= static_cast<std::byte>(bit);
      expect_refused(p, ErrorCode::malformed, {"reserved"});
    }
  FileParts p = parts_of(GgxReflector{0.1f, 0.2f, {1}});
  payload(p)[0] |= std::byte{0x20};
  expect_refused(p, ErrorCode::malformed, {"multiple scattering"});
}

TEST(AnalyticFields, TheLengthIsThatOfTheKind) {
  for (const test::NamedModel& named : test::all_models()) {
    if (named.name == "five channels") continue;
    FileParts p = parts_of(named.model);
    payload(p).push_back(std::byte{0});
    expect_refused(p, ErrorCode::malformed, {"bytes, its kind"});
    for (std::size_t n = payload(p).size() - 2; n > 0; --n) {
      payload(p).resize(n);
      expect_refused(p, ErrorCode::malformed, {"bytes, its kind"});
    }
    payload(p).clear();
    expect_refused(p, ErrorCode::malformed, {"empty"});
  }
}

TEST(AnalyticFields, TheComponentSaysWhatTheModelIs) {
  for (const unsigned bits : {0x20U, 0x40U, 0x60U, 0x24U}) {
    FileParts p = parts_of(Lambert{{0.5f, 0.5f, 0.5f}});
    p.component[0] = static_cast<std::byte>(bits);
    if (bits != 0x60U) expect_refused(p, ErrorCode::malformed, {"symmetries"});
    p = parts_of(Dielectric{});
    p.component[0] = static_cast<std::byte>(bits);
    if (bits != 0x20U) expect_refused(p, ErrorCode::malformed, {"symmetries"});
  }
  FileParts p = parts_of(Lambert{{0.5f, 0.5f, 0.5f}});
  p.component[1] = std::byte{1U << 2};
  expect_refused(p, ErrorCode::malformed, {"transform"});
}

TEST(AnalyticFields, NothingElseDescribesTheMaterial) {
  const FileParts layered = test::parts_of(container::pack(test::layered_content()));
  const FileParts model = parts_of(Lambert{{0.5f, 0.5f, 0.5f}});
  for (const bool first : {true, false}) {
    FileParts p = layered;
    p.component = model.component;
    p.chunks.insert(first ? p.chunks.begin() : p.chunks.begin() + 1, model.chunks[0]);
    expect_refused(p, ErrorCode::malformed, {"second lobes or analytic"});
  }
  FileParts p = model;
  p.chunks.push_back(layered.chunks[1]);
  expect_refused(p, ErrorCode::malformed, {"residual of an analytic"});
  p = model;
  p.chunks.push_back(layered.chunks[2]);
  expect_refused(p, ErrorCode::malformed, {"refinement"});
  for (const bool before : {true, false}) {
    p = model;
    p.chunks.insert(before ? p.chunks.begin() : p.chunks.end(), {0x8A, {std::byte{1}}, std::nullopt});
    expect_refused(p, ErrorCode::malformed, {"sampling tables"});
  }
}

TEST(AnalyticFields, OverheadIsAtMost24Bytes) {
  for (const test::NamedModel& named : test::all_models()) {
    if (named.name == "five channels") continue;
    const auto bytes = pack_analytic(named.model);
    EXPECT_LE(bytes.size(), test::parts_of(bytes).chunks[0].payload.size() + 24) << named.name;
    const Material m = Material::decode(bytes);
    ASSERT_NE(m.analytic(), nullptr);
    EXPECT_EQ(pack_analytic(*m.analytic()), bytes);
    EXPECT_EQ(m.scatter_flags(), Material::from_analytic(named.model).scatter_flags());
  }
}

TEST(AnalyticFields, LimitsHold) {
  const auto bytes = pack_analytic(Lambert{{0.5f, 0.5f, 0.5f}});
  for (std::uint64_t most = 0; most < 48; most += 16) {
    DecodeOptions options;
    options.limits.max_temporary_bytes = most;
    expect_error(ErrorCode::limit_exceeded, {"analytic model"}, [&] { (void)Material::decode(bytes, options); });
    EXPECT_TRUE(check_file(bytes, options.limits).problem);
  }
}

}  // namespace
}  // namespace brdf
