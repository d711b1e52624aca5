// SPDX-License-Identifier: Apache-2.0
// Every way to evaluate, on every instruction set, against the double reference.
#include "support/direction_batch.h"
#include "support/reference_tolerance.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace {

using namespace brdf;
using test::DirectionBatch;

struct Pairs {
  DirectionBatch wi, wo;
  void push(const Vec3f& a, const Vec3f& b) {
    wi.push(a);
    wo.push(b);
  }
};

Vec3f nudged(const Vec3f& w, double size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vec3d v(w.x + size * normal(random), w.y + size * normal(random), w.z + size * normal(random));
  v.z = std::max(std::fabs(v.z), 1e-3);
  return Vec3f(v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z));
}

/// Directions over the whole hemisphere, near the mirror and the retro direction, near the horizon, in one plane.
Pairs all_kinds(std::size_t each, std::uint32_t seed) {
  std::mt19937 random(seed);
  Pairs p;
  const DirectionBatch a = test::random_directions(each, seed + 1), b = test::random_directions(each, seed + 2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t i = 0; i < each; ++i) {
    const Vec3f w = a[i], mirror{-w.x, -w.y, w.z};
    const double size = std::pow(10.0, -6 * uniform(random));
    const auto grazing = [&] { return test::direction_at(std::pow(10.0, -3 * uniform(random)), 6.28 * uniform(random)); };
    p.push(w, b[i]);
    p.push(w, nudged(mirror, size, random));
    p.push(w, nudged(w, size, random));
    p.push(nudged({0, 0, 1}, size, random), b[i]);
    p.push(grazing(), grazing());
    const double t = uniform(random) * 1.5, s = uniform(random) * 3 - 1.5;
    p.push({static_cast<float>(std::sin(t)), 0, static_cast<float>(std::cos(t))},
           {static_cast<float>(std::sin(s)), 0, static_cast<float>(std::cos(s))});
  }
  return p;
}

struct Case {
  std::string name;
  LobeSet lobes;
  residual::ResidualGrid grid;
};

std::vector<Case> cases() {
  using namespace brdf::test;
  std::vector<Case> c;
  c.push_back({"lambert", {3, {lambert_lobe(3, 0.5)}}, {}});
  c.push_back({"nothing", {3, {}}, {}});
  c.push_back({"usual", usual_lobes(), {}});
  c.push_back({"narrow", {3, {ggx_lobe(3, 1e-5, 0.5), ggx_lobe(3, 1e-3, 0.2), ggx_lobe(3, 1, 0.1)}}, {}});
  c.push_back({"retro", {3, {ggx_lobe(3, 0.02, 0.5, 1, true), lambert_lobe(3, 0.2), ggx_lobe(3, 0.2, 0.3)}}, {}});
  c.push_back({"reciprocal grid", usual_lobes(), synthetic_grid({})});
  c.push_back({"full grid", usual_lobes(), synthetic_grid({24, 16, 33, 3, false}, 0.3)});
  c.push_back({"reciprocal grid without a mirror", usual_lobes(), synthetic_grid({24, 16, 33, 3, true, false}, 0.3)});
  c.push_back({"spectral without a mirror", usual_lobes(31), synthetic_grid({8, 6, 7, 31, true, false})});
  c.push_back({"grid of single nodes", usual_lobes(), synthetic_grid({1, 1, 1, 3, true})});
  c.push_back({"flat grid", usual_lobes(), synthetic_grid({9, 1, 2, 3, false})});
  c.push_back({"one channel", usual_lobes(1), synthetic_grid({12, 9, 8, 1, true})});
  c.push_back({"two channels", usual_lobes(2), {}});
  c.push_back({"spectral", usual_lobes(31), synthetic_grid({8, 6, 7, 31, true})});
  c.push_back({"many channels", usual_lobes(195), synthetic_grid({6, 5, 4, 195, false})});
  return c;
}

void compare(const test::ReferenceValue& expected, const float* f, std::size_t stride, std::size_t i, const Pairs& p) {
  for (std::size_t c = 0; c < expected.f.size(); ++c) {
    ASSERT_NEAR(f[c * stride], expected.f[c], expected.tolerance[c])
        << "row " << i << " channel " << c << " wi " << p.wi.x[i] << ' ' << p.wi.y[i] << ' ' << p.wi.z[i] << " wo "
        << p.wo.x[i] << ' ' << p.wo.y[i] << ' ' << p.wo.z[i];
  }
}

TEST(EvalDifferential, SingleCallsAndBatchesMeetTheReference) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Material m = test::material_of(c.lobes, c.grid);
    const auto channels = static_cast<std::size_t>(m.channels());
    const Pairs p = all_kinds(channels > 3 ? 40 : 400, 11);
    std::vector<test::ReferenceValue> expected;
    for (std::size_t i = 0; i < p.wi.size(); ++i)
      expected.push_back(test::reference_value(c.lobes, c.grid, p.wi[i], p.wo[i]));
    std::vector<float> row(channels);
    for (std::size_t i = 0; i < p.wi.size(); ++i) {
      m.eval(p.wi[i], p.wo[i], row);
      compare(expected[i], row.data(), 1, i, p);
    }
    test::on_every_target([&] {
      const std::size_t n = p.wi.size(), stride = n + 3;
      std::vector<float> f(channels * stride, -1.0f);
      m.eval(p.wi.span(), p.wo.span(), {f.data(), stride});
      for (std::size_t i = 0; i < n; ++i) compare(expected[i], f.data() + i, stride, i, p);
    });
  }
}

TEST(EvalDifferential, SinglePdfAndBatchPdfAgree) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Material m = test::material_of(c.lobes, c.grid);
    const auto channels = static_cast<std::size_t>(m.channels());
    const Pairs p = all_kinds(100, 12);
    const std::size_t n = p.wi.size();
    std::vector<float> row(channels);
    test::on_every_target([&] {
      std::vector<float> pdf(n), both(n), f(channels * n), g(channels * n);
      m.pdf(p.wi.span(), p.wo.span(), pdf.data());
      m.eval_pdf(p.wi.span(), p.wo.span(), {f.data(), n}, both.data());
      m.eval(p.wi.span(), p.wo.span(), {g.data(), n});
      EXPECT_EQ(pdf, both);
      EXPECT_EQ(f, g);
      for (std::size_t i = 0; i < n; ++i) {
        const float single = m.pdf(p.wi[i], p.wo[i]);
        ASSERT_NEAR(pdf[i], single, 1e-4f * single + 1e-6f) << i;
        ASSERT_EQ(m.eval_pdf(p.wi[i], p.wo[i], row), single);
      }
    });
  }
}

TEST(EvalDifferential, SizesAndOffsetsChangeNothing) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Material m = test::material_of(c.lobes, c.grid);
    const auto channels = static_cast<std::size_t>(m.channels());
    const Pairs p = all_kinds(16, 13);
    const float untouched = -7.0f;
    test::on_every_target([&] {
      const std::size_t all = p.wi.size();
      std::vector<float> whole(channels * all), whole_pdf(all);
      m.eval_pdf(p.wi.span(), p.wo.span(), {whole.data(), all}, whole_pdf.data());
      for (std::size_t size = 0; size <= 67; ++size) {
        const std::size_t first = size % 5, stride = size + 1 + size % 3;
        // filled exactly, so that a sanitizer sees a write behind the end
        std::vector<float> f(channels * stride, untouched), pdf(size + 1, untouched);
        m.eval_pdf(p.wi.part(first, size), p.wo.part(first, size), {f.data(), stride}, pdf.data());
        for (std::size_t i = 0; i < size; ++i) {
          ASSERT_EQ(pdf[i], whole_pdf[first + i]);
          for (std::size_t k = 0; k < channels; ++k) ASSERT_EQ(f[k * stride + i], whole[k * all + first + i]);
        }
        ASSERT_EQ(pdf[size], untouched);
        for (std::size_t k = 0; k < channels; ++k)
          for (std::size_t i = size; i < stride; ++i) ASSERT_EQ(f[k * stride + i], untouched);
      }
    });
  }
}

TEST(EvalDifferential, ReciprocalMaterialsAreSymmetricToTheLastBit) {
  for (const Case& c : cases()) {
    if (!c.grid.empty() && !residual::is_reciprocal(c.grid.azimuth)) continue;
    SCOPED_TRACE(c.name);
    const Material m = test::material_of(c.lobes, c.grid);
    const auto channels = static_cast<std::size_t>(m.channels());
    const Pairs p = all_kinds(200, 14);
    const std::size_t n = p.wi.size();
    std::vector<float> a(channels), b(channels);
    for (std::size_t i = 0; i < n; ++i) {
      m.eval(p.wi[i], p.wo[i], a);
      m.eval(p.wo[i], p.wi[i], b);
      ASSERT_EQ(a, b) << i;
    }
    test::on_every_target([&] {
      std::vector<float> f(channels * n), g(channels * n);
      m.eval(p.wi.span(), p.wo.span(), {f.data(), n});
      m.eval(p.wo.span(), p.wi.span(), {g.data(), n});
      ASSERT_EQ(f, g);
    });
  }
}

TEST(EvalDifferential, ADirectionalGridIsNotSymmetric) {
  const Material m = test::material_of(test::usual_lobes(), test::synthetic_grid({24, 16, 33, 3, false}, 0.3));
  std::array<float, 3> a{}, b{};
  m.eval(test::direction_at(0.9, 0.3), test::direction_at(0.4, 1.9), a);
  m.eval(test::direction_at(0.4, 1.9), test::direction_at(0.9, 0.3), b);
  EXPECT_NE(a, b);
}

}  // namespace
