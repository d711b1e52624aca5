// SPDX-License-Identifier: Apache-2.0
// The exact level of a file in slices: vectors against the table's own evaluation in double, on every instruction set.
#include "decode/node_shift.h"
#include "decode/resample_slices.h"
#include "encode/slice_model.h"
#include "encode/slice_samples.h"
#include "eval/material_impl.h"
#include "residual/half_float.h"
#include "slices/slice_table.h"
#include "support/direction_batch.h"
#include "support/simd_targets.h"
#include "support/slice_measurement.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace brdf;

residual::Coefficients coefficients(double alpha) {
  test::SliceShape shape;
  shape.alpha = alpha;
  const Measurement m = test::slice_measurement(shape);
  residual::Coefficients c;
  c.slices = encode::slice_frame(m, 8).value();
  c.channels = 3;
  c.transform = residual::ChannelTransform::opponent;
  c.order = residual::coefficient_order(residual::order_shapes[0], false, residual::max_coefficients, residual::reach_of(c.slices));
  for (const auto& channel : encode::slice_coefficients(encode::sample_slices(m, c.slices), c.order, c.transform))
    c.values.emplace_back(channel.begin(), channel.end());
  return c;
}

Material exact_material(const slices::SliceTable& table) {
  return test::with_sampling(eval::make_impl({}, test::usual_lobes(), slices::SliceTable(table), EvalLevel::exact));
}

struct Pairs {
  test::DirectionBatch wi, wo;
};

Pairs pairs(std::size_t n) {
  Pairs p;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double phi = 6.283 * uniform(random), narrow = i % 3 == 0 ? 0.02 : 1.0;
    const double ti = 1.55 * uniform(random), to = i % 3 == 0 ? std::min(ti + narrow * uniform(random), 1.55) : 1.55 * uniform(random);
    p.wi.push(test::direction_at(std::cos(ti), phi));
    p.wo.push(test::direction_at(std::cos(to), phi + 3.1416 + narrow * 3 * uniform(random)));
  }
  p.wi.push({0, 0, 1});
  p.wo.push({0, 0, 1});
  p.wi.push({0.6f, 0, 0.8f});
  p.wo.push({-0.6f, 0, 0.8f});
  return p;
}

TEST(EvalSlices, EveryInstructionSetMeetsTheTable) {
  for (const double alpha : {0.05, 0.3}) {
    const slices::SliceTable table(coefficients(alpha));
    const Material m = exact_material(table);
    const Pairs p = pairs(2000);
    const std::size_t n = p.wi.size();
    test::on_every_target([&] {
      std::vector<float> f(3 * n);
      m.eval(p.wi.span(), p.wo.span(), {f.data(), n});
      double worst = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3d wi(p.wi[i]), wo(p.wo[i]);
        float expected[3], single[3];
        table.eval(slices::slice_angles(wi.x, wi.y, wi.z, wo.x, wo.y, wo.z), wo.z, expected);
        m.eval(p.wi[i], p.wo[i], single);
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(single[c], f[c * n + i]) << i;
          const double e = static_cast<double>(expected[c]);
          worst = std::max(worst, std::fabs(static_cast<double>(f[c * n + i]) - e) / (e + 1e-3));
        }
      }
      // what the rounding of unit vectors to float turns, along the steepest flank of the lobe
      EXPECT_LT(worst, 1e-3);
    });
  }
}

TEST(EvalSlices, SizesAndHostileDirectionsAreSafe) {
  const Material m = exact_material(slices::SliceTable(coefficients(0.3)));
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Vec3f hostile[] = {{nan, 0, 1}, {0, nan, nan}, {inf, 0, 1}, {0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {1e30f, 1e30f, 1e30f}, {0, 0, 1e-30f}, {0.6f, 0, 0.8f}};
  test::on_every_target([&] {
    for (std::size_t size = 0; size <= 67; ++size) {
      test::DirectionBatch wi, wo;
      for (std::size_t i = 0; i < size; ++i) {
        wi.push(hostile[i % std::size(hostile)]);
        wo.push(hostile[(i / std::size(hostile)) % std::size(hostile)]);
      }
      std::vector<float> f(3 * size);
      m.eval(wi.span(), wo.span(), {f.data(), size});
      for (const float v : f) {
        ASSERT_TRUE(std::isfinite(v));
        ASSERT_GE(v, 0.0f);
      }
    }
  });
}

TEST(EvalSlices, WeightsAreValueOverDensity) {
  const Material m = exact_material(slices::SliceTable(coefficients(0.3)));
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int k = 0; k < 300; ++k) {
    const Vec3f wo = test::direction_at(0.05 + 0.9 * static_cast<double>(uniform(random)), 6.28 * static_cast<double>(uniform(random)));
    float weight[3], f[3];
    const Sample s = m.sample(wo, {uniform(random), uniform(random), uniform(random)}, weight);
    if (s.pdf == 0) continue;
    m.eval(s.wi, wo, f);
    EXPECT_NEAR(m.pdf(s.wi, wo), s.pdf, 1e-4f * s.pdf + 1e-6f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(weight[c], f[c] * s.wi.z / s.pdf, 1e-5f * (1 + weight[c]));
  }
}

TEST(EvalSlices, TheBalancedTableFollowsTheExactLevel) {
  const residual::Coefficients c = coefficients(0.3);
  const Material exact = exact_material(slices::SliceTable(c));
  residual::Coefficients with_basis = c;
  with_basis.basis.epsilon = 118;
  const Material balanced(eval::make_impl({}, test::usual_lobes(), decode::resample_slices(with_basis, test::usual_lobes(), residual::balanced_grids[0]),
                                          EvalLevel::balanced));
  const Pairs p = pairs(1000);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < p.wi.size(); ++i) {
    if (std::min(p.wi.z[i], p.wo.z[i]) < 0.2f) continue;
    float a[3], b[3];
    exact.eval(p.wi[i], p.wo[i], a);
    balanced.eval(p.wi[i], p.wo[i], b);
    for (int k = 0; k < 3; ++k) sum += static_cast<double>(std::fabs(a[k] - b[k]) / (a[k] + 1e-3f));
    count += 3;
  }
  EXPECT_LT(sum / static_cast<double>(count), 0.01);
}

TEST(NodeShift, FitsLinesToAParabolaAndKeepsWhatIsNotResolved) {
  test::on_every_target([] {
    constexpr std::size_t outer = 3, n = 9, inner = 5;
    std::vector<float> nodes(outer * n * inner), out(nodes.size());
    for (std::size_t a = 0; a < outer; ++a)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < inner; ++k)
          nodes[(a * n + i) * inner + k] = k == 4 ? (i == 4 ? 100.0f : 1.0f) : 1 + 0.01f * static_cast<float>(i * i);
    decode::least_squares_nodes(nodes, outer, n, inner, out);
    for (std::size_t a = 0; a < outer; ++a)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < inner; ++k) {
          const std::size_t at = (a * n + i) * inner + k;
          const bool end = i == 0 || i + 1 == n;
          if (k < 4) {
            EXPECT_NEAR(out[at], nodes[at] - (end ? 0.0f : 0.02f / 12), 1e-6f);
          } else {
            EXPECT_LE(std::fabs(out[at] - nodes[at]), 0.0501f * nodes[at]);
          }
        }
  });
}

TEST(NodeShift, EveryInstructionSetGivesTheSameBits) {
  const residual::Coefficients c = coefficients(0.2);
  std::vector<float> nodes;
  std::mt19937 random(3);
  std::lognormal_distribution<float> values(0, 6);
  for (int i = 0; i < 1003; ++i) nodes.push_back(values(random));
  std::vector<std::uint16_t> expected(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) expected[i] = residual::half_from_float(std::clamp(nodes[i], 6.2e-5f, 32000.0f));
  const residual::Coefficients plain = [&] {
    residual::Coefficients p = c;
    p.slices = {};
    p.order = residual::coefficient_order(residual::order_shapes[2], false, 300, {residual::max_k, residual::max_l, residual::max_m});
    for (auto& v : p.values) v.assign(p.order.size(), 0.01f);
    return p;
  }();
  std::vector<std::uint16_t> sums;
  test::on_every_target([&] {
    std::vector<std::uint16_t> out(nodes.size());
    decode::to_halves(nodes, out);
    EXPECT_EQ(out, expected);
    const std::vector<std::uint16_t> ratio = residual::reconstruct(plain, {31, 17, 13}).ratio;
    if (sums.empty()) sums = ratio;
    EXPECT_EQ(ratio, sums);
  });
}

}  // namespace
