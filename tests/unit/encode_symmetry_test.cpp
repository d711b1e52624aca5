// SPDX-License-Identifier: Apache-2.0
// Reciprocity and mirror symmetry: exact where they are enforced, reported in any case.
#include "support/direction_batch.h"
#include "support/slice_measurement.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <cstring>

namespace brdf {
namespace {

constexpr EvalLevel levels[] = {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact};

EncodeResult compressed(const Measurement& m, SymmetryMode reciprocity, SymmetryMode mirror = SymmetryMode::automatic, std::uint64_t bytes = 900) {
  EncodeOptions o;
  o.effort = 0;
  o.target_size = bytes;
  o.reciprocity = reciprocity;
  o.mirror = mirror;
  return compress(m, o);
}

/// Values of a batch, and of single pairs, at every level; `change` takes a pair to its image.
template <class Change>
void expect_equal_to_the_last_bit(const EncodeResult& r, Change&& change) {
  constexpr std::size_t n = 1537;
  const auto wi = test::random_directions(n, 3), wo = test::random_directions(n, 4);
  test::DirectionBatch image_i, image_o;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [a, b] = change(wi[i], wo[i]);
    image_i.push(a);
    image_o.push(b);
  }
  for (const EvalLevel level : levels) {
    DecodeOptions options;
    options.level = level;
    const Material m = Material::decode(r.bytes, options);
    std::vector<float> here(3 * n), there(3 * n);
    m.eval(wi.span(), wo.span(), {here.data(), n});
    m.eval(image_i.span(), image_o.span(), {there.data(), n});
    EXPECT_EQ(std::memcmp(here.data(), there.data(), here.size() * sizeof(float)), 0) << "batch, " << to_string(level);
    for (std::size_t i = 0; i < n; ++i) {
      float a[3], b[3];
      m.eval(wi[i], wo[i], a);
      m.eval(image_i[i], image_o[i], b);
      ASSERT_EQ(std::memcmp(a, b, sizeof a), 0) << i << " " << to_string(level);
    }
  }
}

const auto exchanged = [](const Vec3f& wi, const Vec3f& wo) { return std::pair(wo, wi); };
const auto mirrored = [](const Vec3f& wi, const Vec3f& wo) { return std::pair(Vec3f{wi.x, -wi.y, wi.z}, Vec3f{wo.x, -wo.y, wo.z}); };

TEST(Symmetry, EnforcedReciprocityIsExactForEverySource) {
  for (const Measurement& m : {test::bumpy_measurement({36, 18, 48, true}, 3, 0.5), test::slice_measurement(), test::bumpy_measurement()}) {
    const EncodeResult r = compressed(m, SymmetryMode::enforce);
    EXPECT_TRUE(r.summary.reciprocal);
    EXPECT_GT(r.summary.refinements, 0);
    expect_equal_to_the_last_bit(r, exchanged);
  }
}

TEST(Symmetry, MirrorImagesAreExact) {
  for (const Measurement& m : {test::bumpy_measurement({36, 18, 48, true}, 3, 0.5), test::slice_measurement()})
    expect_equal_to_the_last_bit(compressed(m, SymmetryMode::keep, SymmetryMode::enforce), mirrored);
}

TEST(Symmetry, AutoKeepsWhatIsWorthItsBytes) {
  const EncodeResult kept = compressed(test::bumpy_measurement({36, 18, 48, true}, 3, 0.5), SymmetryMode::automatic);
  EXPECT_FALSE(kept.summary.reciprocal);
  EXPECT_GT(kept.summary.reciprocity_asymmetry, 1e-3);
  EXPECT_NE(kept.summary.reciprocity.find("kept, which is worth"), std::string::npos) << kept.summary.reciprocity;
}

TEST(Symmetry, AutoEnforcesWhatIsNot) {
  // a full circle without asymmetry: odd harmonics would only cost
  const EncodeResult r = compressed(test::bumpy_measurement({36, 18, 48, true}), SymmetryMode::automatic);
  EXPECT_TRUE(r.summary.reciprocal) << r.summary.reciprocity;
  expect_equal_to_the_last_bit(r, exchanged);
}

TEST(Symmetry, WhatTheMeasurementHasIsSaid) {
  const EncodeResult r = compressed(test::bumpy_measurement(), SymmetryMode::automatic);
  EXPECT_TRUE(r.summary.reciprocal);
  EXPECT_EQ(r.summary.reciprocity_asymmetry, 0);
  EXPECT_NE(r.summary.reciprocity.find("as in the measurement"), std::string::npos);
}

Measurement asymmetric_in_a_mirror() {
  return test::small_measurement({24, 12, 24}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    const double turn = (wi.x * wo.y - wi.y * wo.x) * (wi.z - wo.z);  // reciprocal, and odd in the mirror
    for (double& v : f) v = 0.3 + 0.2 * turn;
  });
}

TEST(Symmetry, AMirrorAsymmetryIsKeptWhereItIsAskedForOrWorthIt) {
  const Measurement m = asymmetric_in_a_mirror();
  const EncodeResult even = compressed(m, SymmetryMode::automatic, SymmetryMode::enforce, 400);
  EXPECT_GT(even.summary.mirror_asymmetry, 1e-4);
  EXPECT_NE(even.summary.mirror.find("enforced"), std::string::npos) << even.summary.mirror;
  expect_equal_to_the_last_bit(even, mirrored);
  for (const SymmetryMode mode : {SymmetryMode::keep, SymmetryMode::automatic}) {
    EncodeOptions o;
    o.effort = 50;
    o.target_size = 400;
    o.mirror = mode;
    const EncodeResult kept = compress(m, o);
    EXPECT_NE(kept.summary.mirror.find("kept"), std::string::npos) << kept.summary.mirror;
    expect_equal_to_the_last_bit(kept, exchanged);
    const Material material = Material::decode(kept.bytes);
    EXPECT_FALSE(material.info().mirror_symmetric);
    EXPECT_TRUE(material.info().reciprocal);
    EXPECT_LT(kept.summary.errors.back().log_mae, 0.3 * even.summary.errors.back().log_mae);
    // on the right side: f = 0.3 + 0.2 turn
    const double z = 0.9, r = std::sqrt(1 - z * z), low = 0.4, s = std::sqrt(1 - low * low);
    const Vec3f wi{static_cast<float>(r), 0, static_cast<float>(z)};
    for (const double side : {1.0, -1.0}) {
      const Vec3f wo{0, static_cast<float>(side * s), static_cast<float>(low)};
      float f[3];
      material.eval(wi, wo, f);
      EXPECT_NEAR(f[0], 0.3 + 0.2 * side * r * s * (z - low), 0.01);
    }
  }
}

TEST(Symmetry, AMirrorAsymmetryThatCannotBeKeptIsSaid) {
  const Measurement m = test::small_measurement({24, 12, 48, true}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    for (double& v : f) v = 0.3 + 0.2 * (wi.x * wo.y - wi.y * wo.x) * wi.z + 0.25 * wi.z * wi.z * wo.z;
  });
  const EncodeResult r = compressed(m, SymmetryMode::keep, SymmetryMode::keep);
  EXPECT_NE(r.summary.mirror.find("cannot be kept"), std::string::npos) << r.summary.mirror;
}

}  // namespace
}  // namespace brdf
