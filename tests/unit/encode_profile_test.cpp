// SPDX-License-Identifier: Apache-2.0
// Files that are made for a scene: better where it looks, sane where it does not, and small where little is asked.
#include "support/expect_error.h"
#include "support/made_profile.h"
#include "support/slice_measurement.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace brdf {
namespace {

constexpr double degrees = std::numbers::pi / 180;
using Asked = std::function<bool(const Vec3d&, const Vec3d&)>;

const Asked retro = [](const Vec3d& wi, const Vec3d& wo) { return test::difference_angle(wi, wo) < 12 * degrees; };
const Asked grazing = [](const Vec3d& wi, const Vec3d& wo) { return wi.z < 0.35 && wo.z < 0.35; };
const Asked peak = [](const Vec3d& wi, const Vec3d& wo) { return test::half_angle(wi, wo) < 10 * degrees; };

const Asked dark = [](const Vec3d& wi, const Vec3d& wo) { return test::half_angle(wi, wo) > 35 * degrees && test::difference_angle(wi, wo) < 35 * degrees; };

std::shared_ptr<const MaterialProfile> profile_of(const Measurement& m, const Asked& asked) {
  return std::make_shared<const MaterialProfile>(test::made_profile(m, asked, 60000));
}

EncodeOptions sized(std::uint64_t bytes, std::shared_ptr<const MaterialProfile> profile = nullptr) {
  EncodeOptions o;
  o.effort = 0;
  o.target_size = bytes;
  o.profile = std::move(profile);
  return o;
}

BatchEval rows_of(const Material& m) {
  return [&m, n = static_cast<std::size_t>(m.channels())](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i) m.eval(wi[i], wo[i], out.subspan(i * n, n));
  };
}

ProfileError error_of(const Measurement& m, const MaterialProfile& asked, std::span<const std::byte> bytes) {
  const MeasurementInterpolator reference(m);
  const auto n = static_cast<std::size_t>(m.channels.count);
  const ProfileComparison comparison(
      [&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
        std::vector<double> f(n);
        for (std::size_t i = 0; i < wi.size(); ++i) {
          reference.eval(Vec3d(wi[i]), Vec3d(wo[i]), f);
          std::copy(f.begin(), f.end(), out.begin() + static_cast<std::ptrdiff_t>(i * n));
        }
      },
      m.channels.count, asked);
  const Material material = Material::decode(bytes);
  return comparison.score(rows_of(material));
}

/// Largest albedo at any level, and that every value is a number and not negative.
double largest_albedo(std::span<const std::byte> bytes) {
  double largest = 0;
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    DecodeOptions options;
    options.level = level;
    const Material m = Material::decode(bytes, options);
    std::vector<float> f(static_cast<std::size_t>(m.channels()));
    for (int i = 0; i < 90; i += 3)
      for (int j = 0; j < 90; j += 3)
        for (int k = 0; k < 360; k += 30) {
          const auto direction = [](double theta, double phi) { return Vec3f(Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta))); };
          m.eval(direction(i * degrees, k * degrees), direction(j * degrees, 0), f);
          for (const float v : f) EXPECT_TRUE(std::isfinite(v) && v >= 0) << i << " " << j << " " << k;
        }
    for (int theta = 0; theta < 88; theta += 10) {
      m.albedo(Vec3f(Vec3d(std::sin(theta * degrees), 0, std::cos(theta * degrees))), f);
      for (const float v : f) largest = std::max(largest, static_cast<double>(v));
    }
  }
  return largest;
}

/// At the same bytes, by how much the error where the scene looks falls; and what is not asked stays sane.
void expect_gain(const Measurement& m, int effort, const Asked& asked, double least_rms, double least_log) {
  constexpr std::uint64_t bytes = 200;
  const auto profile = profile_of(m, asked);
  EncodeOptions plain = sized(bytes), aimed = sized(bytes, profile);
  plain.effort = aimed.effort = effort;
  const EncodeResult usual = compress(m, plain), fitted = compress(m, aimed);
  ASSERT_LE(fitted.bytes.size(), bytes);
  const ProfileError before = error_of(m, *profile, usual.bytes), after = error_of(m, *profile, fitted.bytes);
  EXPECT_GT(before.rms / after.rms, least_rms) << before.rms << " " << after.rms;
  EXPECT_GT(before.log_error / after.log_error, least_log) << before.log_error << " " << after.log_error;
  EXPECT_LT(largest_albedo(fitted.bytes), 1.5 * std::max(1.0, fitted.summary.source_albedo) + 0.02);
  EXPECT_LT(fitted.summary.largest_albedo, 1.5 * std::max(1.0, fitted.summary.source_albedo) + 0.0051);
}

TEST(Profile, FewerErrorsWhereTheSceneLooksSlow) {
  const Measurement m = test::bumpy_measurement();
  expect_gain(m, 0, retro, 1.8, 1.8);
  expect_gain(m, 0, dark, 1.4, 1.4);
  expect_gain(m, 25, grazing, 1.08, 1.15);
  expect_gain(m, 25, peak, 1.08, 1.3);
}

// A scale serves all directions: to bound what nobody looks at by as much as what the scene sees would darken white paper by a tenth.
TEST(Profile, WhiteMaterialsAreNotDarkenedSlow) {
  Measurement white = test::bumpy_measurement();
  const double albedo = compress(white, sized(300)).summary.source_albedo;
  for (float& v : std::get<HalfDifferenceTable>(white.table).values) v /= static_cast<float>(albedo);
  EncodeOptions o = sized(300, profile_of(white, retro));
  const EncodeResult fitted = compress(white, o);
  EXPECT_EQ(fitted.summary.energy_scale, 1);
  EXPECT_GT(fitted.summary.largest_albedo, 1.01) << "it shows nothing";
  o.energy = EnergyMode::clamp;
  EXPECT_LT(compress(white, o).summary.largest_albedo, 1.0051);
}

TEST(Profile, FewerErrorsOfAnInstrumentWithSlicesSlow) {
  const Measurement m = test::slice_measurement();
  expect_gain(m, 25, retro, 1.5, 1.8);
  expect_gain(m, 25, grazing, 1.2, 1.15);
  expect_gain(m, 25, peak, 1.3, 1.5);
}

// A profile that asks for everything alike leaves nothing to gain; the file is as good as the usual one that is as much smaller
// as the chunk that says so.
TEST(Profile, NoProfileMakesAFileWorseSlow) {
  const auto decibels = [](const ProfileError& e) { return -20 * (std::log10(e.rms) + 2 * std::log10(e.log_error)) / 3; };
  for (const Measurement& m : {test::bumpy_measurement(), test::slice_measurement()})
    for (const Asked& asked : {Asked([](const Vec3d&, const Vec3d&) { return true; }), grazing, peak}) {
      const auto profile = profile_of(m, asked);
      constexpr std::uint64_t chunk = 15;
      const EncodeResult usual = compress(m, sized(300 - chunk)), fitted = compress(m, sized(300, profile));
      EXPECT_GT(decibels(error_of(m, *profile, fitted.bytes)), decibels(error_of(m, *profile, usual.bytes)) - 0.3);
    }
}

TEST(Profile, TheFileSaysWhatItIsFitFor) {
  const Measurement m = test::bumpy_measurement();
  EncodeOptions o = sized(250, profile_of(m, grazing));
  o.profile_share = 0.125;
  const EncodeResult r = compress(m, o);
  const std::optional<FittedFor> said = Material::decode(r.bytes).info().fitted_for;
  ASSERT_TRUE(said.has_value());
  EXPECT_EQ(said->operations, 1U);
  EXPECT_EQ(said->level, EvalLevel::balanced);
  EXPECT_DOUBLE_EQ(said->share, 0.125);
  EXPECT_NEAR(said->footprint_pixels, 100, 5);
  EXPECT_NEAR(said->theta_i_least, std::acos(0.35), 0.02);
  EXPECT_NEAR(said->theta_o_most, std::acos(0.03), 0.02);
  // rounded to the pessimistic side, by less than an eighth of an octave
  const ProfileError truth = error_of(m, *o.profile, r.bytes);
  EXPECT_NEAR(r.summary.profile.rms, truth.rms, 1e-3 * truth.rms);
  EXPECT_GE(said->rms, r.summary.profile.rms);
  EXPECT_LE(said->rms, r.summary.profile.rms * 1.0906);
  EXPECT_GE(said->log_error, r.summary.profile.log_error);
  EXPECT_LE(said->log_error, r.summary.profile.log_error * 1.0906);
  EXPECT_FALSE(Material::decode(compress(m, sized(250)).bytes).info().fitted_for.has_value());
}

TEST(Profile, ThreadsHaveNoEffectOnTheBytes) {
  const Measurement m = test::bumpy_measurement();
  EncodeOptions o = sized(220, profile_of(m, peak));
  const EncodeResult one = compress(m, o);
  o.threads = 3;
  EXPECT_EQ(one.bytes, compress(m, o).bytes);
}

TEST(Profile, TargetsUnderAProfileAreMetSlow) {
  const Measurement m = test::bumpy_measurement();
  EncodeOptions o = sized(0, profile_of(m, retro));
  o.target_size.reset();
  std::size_t before = SIZE_MAX;
  for (const double rms : {0.02, 0.05, 0.5}) {
    o.target_error = ErrorTarget{Metric::profile, rms};
    const EncodeResult r = compress(m, o);
    EXPECT_LE(error_of(m, *o.profile, r.bytes).rms, rms);
    EXPECT_LE(r.bytes.size(), before);
    before = r.bytes.size();
    if (rms == 0.5) {  // of what hardly matters a single lobe is left
      EXPECT_EQ(r.summary.lobes, 1);
      EXPECT_EQ(r.summary.refinements, 0);
      EXPECT_LE(r.bytes.size(), 64U);
    }
  }
}

TEST(Profile, TablesForSamplingAreLeftOutWhereNobodySamples) {
  const Measurement m = test::bumpy_measurement();
  MaterialProfile asked = test::made_profile(m, peak, 20000);
  EncodeOptions o = sized(6000, std::make_shared<const MaterialProfile>(asked));
  o.store_cdf = true;
  const EncodeResult without = compress(m, o);
  EXPECT_EQ(without.summary.cdf_bytes, 0U);
  EXPECT_NE(without.summary.left_out.find("no sample"), std::string::npos);
  asked.operations[static_cast<std::size_t>(ProfileOperation::sample)] = 1;
  o.profile = std::make_shared<const MaterialProfile>(asked);
  const EncodeResult with = compress(m, o);
  EXPECT_GT(with.summary.cdf_bytes, 0U);
  EXPECT_TRUE(with.summary.left_out.empty());
  EXPECT_TRUE(Material::decode(with.bytes).info().fitted_for.has_value());
}

// A renderer fills the holes of a table with something; what it asked there must not count as black.
TEST(Profile, WhatWasNotMeasuredDoesNotCount) {
  const auto asked = profile_of(test::bumpy_measurement(), grazing);
  const auto answer = [](float whole, float holes) -> BatchEval {
    return [=](std::span<const Vec3f> wi, std::span<const Vec3f>, std::span<float> out) {
      for (std::size_t i = 0; i < wi.size(); ++i) out[i] = wi[i].z < 0.3F ? holes : whole;
    };
  };
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const ProfileError whole = ProfileComparison(answer(1, nothing), 1, *asked).score(answer(1.25F, 1e9F));
  EXPECT_NEAR(whole.rms, 0.25, 1e-6);
  EXPECT_GT(ProfileComparison(answer(1, 0), 1, *asked).score(answer(1.25F, 1e9F)).rms, 1e6);
  test::expect_error(ErrorCode::no_data, {"measured"}, [&] { ProfileComparison(answer(nothing, nothing), 1, *asked); });
}

TEST(Profile, WhatCannotBeDoneIsRefused) {
  const Measurement m = test::bumpy_measurement();
  test::expect_error(ErrorCode::no_data, {"asks nothing"}, [&] { compress(m, sized(200, std::make_shared<const MaterialProfile>())); });
  EncodeOptions o;
  o.target_error = ErrorTarget{Metric::profile, 0.1};
  test::expect_error(ErrorCode::invalid_argument, {"needs a profile"}, [&] { compress(m, o); });
  o = sized(200, profile_of(m, peak));
  o.profile_share = 1.5;
  test::expect_error(ErrorCode::invalid_argument, {"share", "1.5"}, [&] { compress(m, o); });
}

}  // namespace
}  // namespace brdf
