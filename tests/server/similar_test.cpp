// SPDX-License-Identifier: Apache-2.0
// Near in the descriptor is alike to the eye.
#include "query/similar_index.h"

#include <brdf/material.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace brdf;
using namespace brdf::service;

struct Look {
  double r, g, b, specular, alpha;
};

Material material(const Look& look) {
  const std::vector<double> gloss(3, look.specular);
  return Material::from_lobes({3, {{LobeKind::lambert, 1, 1, {look.r, look.g, look.b}}, {LobeKind::ggx, look.alpha, 1, gloss}}});
}

double distance(const Look& a, const Look& b) {
  SimilarIndex index({describe(material(b))});
  return index.nearest(describe(material(a)), 1).at(0).distance;
}

TEST(Descriptor, OrdersChangesAsAnEyeDoes) {
  const Look red{0.5, 0.05, 0.05, 0.04, 0.3};
  const Look redder{0.55, 0.05, 0.05, 0.04, 0.3}, orange{0.5, 0.2, 0.05, 0.04, 0.3}, blue{0.05, 0.05, 0.5, 0.04, 0.3};
  EXPECT_EQ(distance(red, red), 0);
  EXPECT_LT(distance(red, redder), distance(red, orange));
  EXPECT_LT(distance(red, orange), distance(red, blue));
  const Look rougher{0.5, 0.05, 0.05, 0.04, 0.33}, sharp{0.5, 0.05, 0.05, 0.04, 0.05};
  EXPECT_LT(distance(red, rougher), distance(red, sharp)) << "the width of the highlight";
  EXPECT_LT(distance(red, sharp), distance(red, blue)) << "a small highlight weighs less than the colour of the whole";
}

TEST(Descriptor, ColourOfASpectrumIsThatOfItsBands) {
  Channels spectrum{ChannelModel::spectral, 31, {}};
  std::vector<float> f;
  for (int i = 0; i < 31; ++i) {
    spectrum.wavelengths_nm.push_back(400 + 10 * static_cast<float>(i));
    f.push_back(i >= 20 ? 0.5F : i >= 10 ? 0.25F : 0.125F);
  }
  EXPECT_EQ(descriptor_color(spectrum, f), (std::array<double, 3>{0.5, 0.25, 0.125}));
  EXPECT_EQ(descriptor_color({ChannelModel::scalar, 1, {}}, std::vector<float>{0.5F}), (std::array<double, 3>{0.5, 0.5, 0.5}));
  // The white of sRGB, IEC 61966-2-1.
  for (const double v : descriptor_color({ChannelModel::xyz, 3, {}}, std::vector<float>{0.9505F, 1, 1.089F})) EXPECT_NEAR(v, 1, 1e-3);
}

TEST(SimilarIndex, IsExact) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 2);
  std::vector<Descriptor> all(500);
  for (Descriptor& d : all)
    for (float& v : d) v = uniform(random);
  const SimilarIndex index(all);
  for (int q = 0; q < 20; ++q) {
    Descriptor wanted;
    for (float& v : wanted) v = uniform(random);
    double best = 1e9;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < descriptor_size; ++k) sum += std::pow(static_cast<double>(all[i][k] - wanted[k]), 2);
      if (sum < best) {
        best = sum;
        nearest = i;
      }
    }
    const auto found = index.nearest(wanted, 5);
    ASSERT_EQ(found.size(), 5U);
    EXPECT_EQ(found[0].index, nearest);
    EXPECT_NEAR(found[0].distance, std::sqrt(best / descriptor_size), 1e-5);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i - 1].distance, found[i].distance);
  }
  EXPECT_TRUE(SimilarIndex({}).nearest(all[0], 3).empty());
}

}  // namespace
