// SPDX-License-Identifier: Apache-2.0
#include "residual/coefficient_model.h"
#include "residual/coefficient_order.h"
#include "residual/order_extent.h"
#include "residual/residual_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace brdf::residual {
namespace {

using Key = std::tuple<int, int, int, int>;  // radius, m, l, k: the order that the format states

Key key(const OrderShape& s, const Frequency& f) { return {s.k * f.k + s.l * f.l + s.m * f.m, f.m, f.l, f.k}; }

std::vector<Key> sorted_by_brute_force(const OrderShape& shape, bool even) {
  std::vector<Key> all;
  for (int k = 0; k < max_k; ++k)
    for (int l = 0; l < max_l; ++l)
      for (int m = 0; m < max_m; m += even ? 2 : 1) all.emplace_back(shape.k * k + shape.l * l + shape.m * m, m, l, k);
  std::sort(all.begin(), all.end());
  return all;
}

TEST(CoefficientOrder, IsTheSortedListOfAllFrequencies) {
  for (const OrderShape& shape : order_shapes)
    for (const bool even : {false, true}) {
      const std::vector<Key> expected = sorted_by_brute_force(shape, even);
      const auto order = coefficient_order(shape, even, max_coefficients);
      ASSERT_EQ(order.size(), max_coefficients);
      for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(key(shape, order[i]), expected[i]) << i;
    }
}

TEST(CoefficientOrder, ShortListsAreBeginningsOfLongOnes) {
  for (const OrderShape& shape : order_shapes) {
    const auto all = coefficient_order(shape, true, 400);
    for (std::uint32_t count = 0; count <= 400; ++count) {
      const auto some = coefficient_order(shape, true, count);
      ASSERT_EQ(some.size(), count);
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(key(shape, some[i]), key(shape, all[i]));
    }
  }
}

TEST(CoefficientOrder, EndsWhereTheBoundsRunOut) {
  EXPECT_EQ(coefficient_order(order_shapes[0], false, 1000000).size(), std::size_t{max_k} * max_l * max_m);
  EXPECT_EQ(coefficient_order(order_shapes[0], true, 1000000).size(), std::size_t{max_k} * max_l * max_m / 2);
}

TEST(CoefficientOrder, FirstPlacesOfShape0) {
  // radius 0, 10, 17, 20, 24, 27, 30, 34 (two: l 2; k 1 m 1), 37: written out so that a change of the table shows
  const auto order = coefficient_order(order_shapes[0], false, 10);
  const std::array<std::array<int, 3>, 10> expected{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 0, 1}, {1, 1, 0}, {3, 0, 0}, {0, 2, 0}, {1, 0, 1}, {2, 1, 0}}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::array<int, 3> found{order[i].k, order[i].l, order[i].m};
    EXPECT_EQ(found, expected[i]) << i;
  }
}

TEST(CoefficientOrder, ShapesAreThoseOfTheFormat) {
  // entries are only ever added: files of version 1 refer to these
  constexpr int expected[8][3] = {{10, 17, 24}, {8, 20, 30}, {6, 20, 30}, {14, 14, 22},
                                  {10, 20, 17}, {8, 12, 40}, {5, 30, 40}, {14, 20, 14}};
  static_assert(order_shape_count >= 8);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(order_shapes[i].k, expected[i][0]);
    EXPECT_EQ(order_shapes[i].l, expected[i][1]);
    EXPECT_EQ(order_shapes[i].m, expected[i][2]);
  }
}

TEST(OrderExtent, IsOnePastTheLargest) {
  const std::vector<Frequency> order{{0, 3, 1}, {7, 0, 0}, {2, 2, 4}};
  const Extent e = extent(order);
  EXPECT_EQ(e.k, 8);
  EXPECT_EQ(e.l, 4);
  EXPECT_EQ(e.m, 5);
  EXPECT_EQ(extent({}).k, 0);
}

TEST(Contexts, ClassesHaveTheirBounds) {
  const std::vector<int> activity{0, 1, 2, 3, 4, 4, 5, 5, 5, 6, 6, 6, 6, 6, 7, 7};
  for (std::size_t v = 0; v < activity.size(); ++v)
    EXPECT_EQ(activity_class(static_cast<std::uint32_t>(v)), activity[v]) << v;
  EXPECT_EQ(activity_class(1000000), 7);
  const std::vector<std::pair<std::uint32_t, int>> radius{{0, 0},  {5, 0},  {6, 1},  {11, 1}, {12, 2}, {23, 2},
                                                          {24, 3}, {47, 3}, {48, 4}, {95, 4}, {96, 5}, {16383, 5}};
  for (const auto& [j, expected] : radius) EXPECT_EQ(radius_class(j), expected) << j;
}

/// Magnitudes by name, without the borders of the real one.
struct PlainField {
  std::map<std::tuple<int, int, int, int>, std::uint32_t> magnitude;
  std::uint32_t at(int c, int k, int l, int m) const {
    const auto found = magnitude.find({c, k, l, m});
    return found == magnitude.end() ? 0 : found->second;
  }
  std::uint32_t activity(int c, int k, int l, int m, bool even) const {
    std::uint32_t v = 2 * at(c, k - 1, l, m) + at(c, k - 2, l, m) + 2 * at(c, k, l - 1, m) + at(c, k, l - 2, m) +
                      at(c, k - 1, l - 1, m) + at(c, k, l, m - 2) + (even ? at(c, k, l, m - 2) : at(c, k, l, m - 1));
    if (c > 0) v += 2 * at(0, k, l, m);
    if (c > 1) v += at(c - 1, k, l, m);
    return v;
  }
};

TEST(Contexts, ActivityIsTheDocumentedSumOfNeighbours) {
  for (const bool even : {false, true}) {
    const auto order = coefficient_order(order_shapes[3], even, 300);
    const Extent e = extent(order);
    MagnitudeField field(4, e.k, e.l, e.m);
    PlainField plain;
    std::uint32_t state = 17;
    for (const Frequency& f : order)
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(field.activity(c, f, even), plain.activity(c, f.k, f.l, f.m, even));
        state = state * 1664525U + 1013904223U;
        const auto q = static_cast<std::int32_t>(state >> 22) - 512;
        field.set(c, f, q);
        plain.magnitude[{c, f.k, f.l, f.m}] = static_cast<std::uint32_t>(std::min(std::abs(q), 255));
      }
    field.clear();
    for (const Frequency& f : order) ASSERT_EQ(field.activity(3, f, even), 0U);
  }
}

}  // namespace
}  // namespace brdf::residual
