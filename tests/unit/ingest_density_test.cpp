// SPDX-License-Identifier: Apache-2.0
// The map that makes a bilinear density uniform, against integrals done by hand.
#include "ingest/bilinear_density.h"

#include <gtest/gtest.h>

namespace brdf::ingest {
namespace {

constexpr SliceBlend first_slice = {{{0, 1.0}, {0, 0.0}}};

TEST(BilinearDensity, UniformIsTheIdentity) {
  const BilinearDensity d(std::vector<float>(12, 3.0f), 3, 4);
  for (double u = 0; u <= 1; u += 0.125) {
    const SquarePoint s = d.to_uniform({u, 1 - u}, first_slice);
    EXPECT_NEAR(s.u, u, 1e-15);
    EXPECT_NEAR(s.v, 1 - u, 1e-15);
  }
}

TEST(BilinearDensity, LinearAlongTheWidthIntegratesToASquare) {
  const BilinearDensity d({0, 1, 0, 1}, 2, 2);
  const SquarePoint s = d.to_uniform({0.3, 0.8}, first_slice);
  EXPECT_NEAR(s.u, 0.09, 1e-15);
  EXPECT_NEAR(s.v, 0.8, 1e-15);
}

TEST(BilinearDensity, LinearAlongTheHeightIntegratesToASquare) {
  const BilinearDensity d({0, 0, 1, 1}, 2, 2);
  const SquarePoint s = d.to_uniform({0.3, 0.8}, first_slice);
  EXPECT_NEAR(s.u, 0.3, 1e-15);
  EXPECT_NEAR(s.v, 0.64, 1e-15);
}

TEST(BilinearDensity, TheRowIsInterpolatedBeforeItIsIntegrated) {
  // at v = 1/4 the row runs from 3/4 to 1/4, normalised 2 (3/4 - u / 2), integral 3/2 u - u^2 / 2
  const BilinearDensity d({1, 0, 0, 1}, 2, 2);
  const SquarePoint s = d.to_uniform({0.5, 0.25}, first_slice);
  EXPECT_NEAR(s.u, 0.625, 1e-15);
  EXPECT_NEAR(s.v, 0.25, 1e-15);
}

TEST(BilinearDensity, CellsAddUpAlongRowAndColumn) {
  // row 0, 1, 0: half of the mass in each cell; integral to u = 3/4 (middle of the second cell): 1/2 + 3/8
  const BilinearDensity d({0, 1, 0, 0, 1, 0, 0, 1, 0}, 3, 3);
  const SquarePoint s = d.to_uniform({0.75, 0.75}, first_slice);
  EXPECT_NEAR(s.u, 0.875, 1e-15);
  EXPECT_NEAR(s.v, 0.75, 1e-15);
}

TEST(BilinearDensity, SlicesAreNormalisedAndThenBlended) {
  // slice 0 uniform, slice 1 is 2 u whatever its scale: half of each gives u / 2 + u^2 / 2
  const BilinearDensity d({7, 7, 7, 7, 0, 5, 0, 5}, 2, 2);
  const SquarePoint s = d.to_uniform({0.5, 0.5}, {{{0, 0.5}, {1, 0.5}}});
  EXPECT_NEAR(s.u, 0.375, 1e-15);
}

TEST(BilinearDensity, EndsMapToEnds) {
  const BilinearDensity d({1, 2, 3, 4, 5, 6}, 2, 3);
  for (const double end : {0.0, 1.0}) {
    const SquarePoint s = d.to_uniform({end, end}, first_slice);
    EXPECT_NEAR(s.u, end, 1e-15);
    EXPECT_NEAR(s.v, end, 1e-15);
  }
}

TEST(BilinearDensity, ASliceOfZerosStaysFinite) {
  const BilinearDensity d(std::vector<float>(4, 0.0f), 2, 2);
  const SquarePoint s = d.to_uniform({0.5, 0.5}, first_slice);
  EXPECT_EQ(s.u, 0);
  EXPECT_EQ(s.v, 0);
}

}  // namespace
}  // namespace brdf::ingest
