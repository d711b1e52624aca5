// SPDX-License-Identifier: Apache-2.0
#include "residual/grid_coordinates.h"
#include "residual/half_float.h"
#include "residual/reconstruct.h"
#include "support/brdfc_content.h"
#include "support/direct_basis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brdf::residual {
namespace {

using test::direct_log_ratio;
using test::ResidualAngles;

Coefficients coefficients_of(int channels, bool reciprocal, ChannelTransform transform, std::uint32_t count) {
  const ResidualCode code = test::residual_of(
      channels, reciprocal, {{48, false, std::vector<std::uint32_t>(static_cast<std::size_t>(channels), count)}});
  return dequantise(code, transform, 1);
}

/// Every node against the sum of its terms; half floats carry 2^-11.
void expect_nodes_match(const Coefficients& c, const GridSize& size) {
  const ResidualGrid grid = reconstruct(c, size);
  ASSERT_EQ(grid.channels, c.channels);
  ASSERT_EQ(grid.n_p, c.azimuth == Azimuth::symmetric ? (size.n_p + 1) / 2 : size.n_p);
  ASSERT_EQ(grid.ratio.size() * sizeof(std::uint16_t), grid_bytes(size, c.azimuth, c.channels));
  double worst = 0;
  for (int h = 0; h < grid.n_h; ++h)
    for (int d = 0; d < grid.n_d; ++d)
      for (int p = 0; p < grid.n_p; ++p) {
        const auto theta = [](int i, int n, double kappa) {
          return 2 * std::asin(unwarp(static_cast<double>(i) / (n - 1), kappa) / std::numbers::sqrt2);
        };
        const double v = static_cast<double>(p) / (grid.n_p - 1) * (c.azimuth == Azimuth::symmetric ? 0.5 : 1.0);
        const ResidualAngles a{theta(h, grid.n_h, kappa_h_of(c.basis.kappa_h)),
                               theta(d, grid.n_d, kappa_d_of(c.basis.kappa_d)), std::acos(cos_phi_of(v))};
        for (int ch = 0; ch < grid.channels; ++ch) {
          const std::size_t at = static_cast<std::size_t>(((h * grid.n_d + d) * grid.n_p + p) * grid.channels + ch);
          const double found = std::log(static_cast<double>(float_from_half(grid.ratio[at])));
          worst = std::max(worst, std::abs(found - direct_log_ratio(c, static_cast<std::size_t>(ch), a)));
        }
      }
  EXPECT_LT(worst, 0.5 / 1024 + 1e-4);
}

TEST(Reconstruct, NodesAreTheSumOfTheBasis) {
  expect_nodes_match(coefficients_of(3, false, ChannelTransform::opponent, 120), {17, 12, 9});
  expect_nodes_match(coefficients_of(3, true, ChannelTransform::opponent, 120), {17, 12, 9});
}

TEST(Reconstruct, SinesMakeTheMirrorAsymmetry) {
  Coefficients c = coefficients_of(3, false, ChannelTransform::opponent, 120);
  c.azimuth = Azimuth::reciprocal;
  expect_nodes_match(c, {17, 12, 9});
}

TEST(Reconstruct, OtherTransformsAndChannelCounts) {
  expect_nodes_match(coefficients_of(1, false, ChannelTransform::identity, 60), {9, 8, 7});
  expect_nodes_match(coefficients_of(7, true, ChannelTransform::cosine, 40), {9, 8, 7});
  expect_nodes_match(coefficients_of(2, true, ChannelTransform::opponent, 40), {9, 8, 7});
}

TEST(Reconstruct, LevelsUseTheDocumentedSizes) {
  // docs/format.md names them: files do not depend on them, recorded errors do
  EXPECT_EQ(balanced_grids[0].n_h, 56);
  EXPECT_EQ(balanced_grids[0].n_d, 28);
  EXPECT_EQ(balanced_grids[0].n_p, 25);
  EXPECT_EQ(exact_grid.n_h, 128);
  EXPECT_EQ(exact_grid.n_d, 64);
  EXPECT_EQ(exact_grid.n_p, 49);
}

TEST(Reconstruct, ExtremeCoefficientsStayNormalHalves) {
  Coefficients c = coefficients_of(3, false, ChannelTransform::identity, 200);
  for (auto& channel : c.values)
    for (float& v : channel) v *= 1e7F;
  const ResidualGrid grid = reconstruct(c, {9, 8, 7});
  for (std::size_t i = 0; i + 8 < grid.ratio.size(); ++i) ASSERT_TRUE(is_positive_normal_half(grid.ratio[i]));
}

TEST(Reconstruct, NoCoefficientGivesRatioOne) {
  Coefficients c = coefficients_of(3, true, ChannelTransform::opponent, 10);
  for (auto& channel : c.values) std::fill(channel.begin(), channel.end(), 0.0F);
  const ResidualGrid grid = reconstruct(c, {5, 4, 3});
  for (std::size_t i = 0; i + 8 < grid.ratio.size(); ++i) ASSERT_EQ(grid.ratio[i], half_from_float(1.0F));
}

TEST(DirectBasis, AnglesAgreeWithTheirDefinition) {
  // directions made from angles must give them back, so that the yardstick of these tests is itself tested
  for (const double theta_h : {0.1, 0.7, 1.2})
    for (const double theta_d : {0.05, 0.4})
      for (const double phi_d : {-2.0, 0.3, 1.5, 3.0})
        for (const double turn : {0.0, 1.1}) {
          Vec3d wi, wo;
          geometry::directions_from_half_difference(theta_h, theta_d, phi_d, wi, wo);
          const auto rotate = [turn](const Vec3d& v) {
            return Vec3d{std::cos(turn) * v.x - std::sin(turn) * v.y, std::sin(turn) * v.x + std::cos(turn) * v.y, v.z};
          };
          const ResidualAngles a = test::residual_angles(rotate(wi), rotate(wo));
          EXPECT_NEAR(a.theta_h, theta_h, 1e-12);
          EXPECT_NEAR(a.theta_d, theta_d, 1e-12);
          EXPECT_NEAR(std::cos(a.phi_d), std::cos(phi_d), 1e-12);
          EXPECT_NEAR(std::sin(a.phi_d), std::sin(phi_d), 1e-12);
        }
}

}  // namespace
}  // namespace brdf::residual
