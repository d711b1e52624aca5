// SPDX-License-Identifier: Apache-2.0
// Degenerate and hostile directions: finite, not negative, 0 below the horizon; and what make_impl refuses.
#include "support/direction_batch.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <brdf/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace {

using namespace brdf;

std::vector<Vec3f> odd_directions() {
  const float tiny = std::numeric_limits<float>::min(), denormal = std::numeric_limits<float>::denorm_min();
  std::vector<Vec3f> w = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f},
                          {0.6f, 0, -0.8f}, {1, 0, -0.0f}, {0, 0, 0}};
  for (float z : {tiny, denormal, 1e-30f, 1e-20f, 1e-12f, 1e-8f, 1e-5f, 1e-3f}) {
    w.push_back({1, 0, z});
    w.push_back({-1, 0, z});
    w.push_back({0.6f, -0.8f, z});
  }
  for (float e : {1e-8f, 1e-6f, 1e-4f}) {
    w.push_back({e, 0, 1});
    w.push_back({-e, e, 1});
    w.push_back({0.6f + e, 0, 0.8f});
  }
  w.push_back({0.6f * 1.0005f, 0, 0.8f * 1.0005f});
  return w;
}

std::vector<Material> odd_materials() {
  using namespace brdf::test;
  residual::ResidualGrid high = synthetic_grid({});
  for (std::size_t i = 0; i + 8 < high.ratio.size(); ++i) high.ratio[i] = i % 2 ? residual::half_max : residual::half_min_normal;
  const LobeSet narrow{3, {ggx_lobe(3, 1e-5, 1e4, 1e4), ggx_lobe(3, 1e-5, 1, 1, true), ggx_lobe(3, 1, 1)}};
  return {material_of(usual_lobes()),          material_of(narrow),
          material_of(narrow, high),           material_of(usual_lobes(), synthetic_grid({})),
          material_of({3, {}}, synthetic_grid({})), material_of(usual_lobes(5), synthetic_grid({5, 4, 3, 5, false}))};
}

TEST(EvalEdgeCases, EveryPairIsFiniteNotNegativeAndZeroBelowTheHorizon) {
  const std::vector<Vec3f> odd = odd_directions();
  test::DirectionBatch wi, wo;
  for (const Vec3f& a : odd)
    for (const Vec3f& b : odd) {
      wi.push(a);
      wo.push(b);
    }
  for (const Material& m : odd_materials()) {
    const auto channels = static_cast<std::size_t>(m.channels());
    const std::size_t n = wi.size();
    std::vector<float> row(channels);
    const auto check = [&](std::size_t i, float f, float pdf) {
      const bool above = wi.z[i] > 0 && wo.z[i] > 0;
      ASSERT_TRUE(std::isfinite(f) && f >= 0 && std::isfinite(pdf) && pdf >= 0) << f << ' ' << pdf << " pair " << i << " wi "
          << wi.x[i] << ' ' << wi.y[i] << ' ' << wi.z[i] << " wo " << wo.x[i] << ' ' << wo.y[i] << ' ' << wo.z[i];
      ASSERT_TRUE(above || (f == 0 && pdf == 0)) << i;
    };
    for (std::size_t i = 0; i < n; ++i) {
      const float pdf = m.eval_pdf(wi[i], wo[i], row);
      for (float f : row) check(i, f, pdf);
    }
    test::on_every_target([&] {
      std::vector<float> f(channels * n), pdf(n);
      m.eval_pdf(wi.span(), wo.span(), {f.data(), n}, pdf.data());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < channels; ++c) check(i, f[c * n + i], pdf[i]);
    });
  }
}

TEST(EvalEdgeCases, WhatIsNoDirectionGivesZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  test::DirectionBatch wi, wo;
  for (float bad : {nan, inf, 1e20f})
    for (const Vec3f& w : {Vec3f{bad, 0, 1}, Vec3f{0, bad, 1}, Vec3f{0, 0, bad}, Vec3f{bad, bad, bad}}) {
      wi.push(w);
      wo.push({0.6f, 0, 0.8f});
      wi.push({0.6f, 0, 0.8f});
      wo.push(w);
    }
  for (const Material& m : odd_materials()) {
    const auto channels = static_cast<std::size_t>(m.channels());
    const std::size_t n = wi.size();
    std::vector<float> row(channels, 1.0f);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(m.eval_pdf(wi[i], wo[i], row), 0);
      EXPECT_EQ(row, std::vector<float>(channels, 0.0f));
    }
    test::on_every_target([&] {
      std::vector<float> f(channels * n, 1.0f), pdf(n, 1.0f);
      m.eval_pdf(wi.span(), wo.span(), {f.data(), n}, pdf.data());
      EXPECT_EQ(f, std::vector<float>(channels * n, 0.0f));
      EXPECT_EQ(pdf, std::vector<float>(n, 0.0f));
    });
  }
}

TEST(EvalEdgeCases, SimdTargetNamesTheOneInUse) {
  const std::string best = simd_target();
  EXPECT_FALSE(best.empty());
  for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    const test::UseTarget use(target);
    const bool scalar = target == HWY_SCALAR || target == HWY_EMU128;
    EXPECT_STREQ(simd_target(), scalar ? "scalar" : hwy::TargetName(target));
  }
  EXPECT_EQ(simd_target(), best);
}

TEST(EvalEdgeCases, HandleReportsWhatItHolds) {
  const Material lobes = Material::from_lobes(test::usual_lobes());
  EXPECT_EQ(lobes.channels(), 3);
  EXPECT_EQ(lobes.level(), EvalLevel::fast);
  EXPECT_EQ(lobes.lobes().lobes.size(), 3u);
  EXPECT_TRUE(lobes.info().reciprocal);
  EXPECT_LT(lobes.resident_bytes(), 1024u);
  const Material grid = test::material_of(test::usual_lobes(), test::synthetic_grid({}));
  EXPECT_EQ(grid.level(), EvalLevel::balanced);
  EXPECT_GE(grid.resident_bytes() - lobes.resident_bytes(), 48u * 28 * 24 * 6);
}

void expect_refused(ErrorCode code, const std::string& words, const std::function<void()>& work) {
  try {
    work();
    ADD_FAILURE() << "accepted: " << words;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code) << e.what();
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

TEST(EvalEdgeCases, LobeSetsThatCannotBeEvaluatedAreRefused) {
  const auto refused = [](const std::string& words, const std::function<void(LobeSet&)>& spoil,
                          ErrorCode code = ErrorCode::invalid_argument) {
    LobeSet set = test::usual_lobes();
    spoil(set);
    expect_refused(code, words, [&] { Material::from_lobes(set); });
  };
  refused("channels is 0", [](LobeSet& s) { s.channels = 0; });
  refused("channels is 5000", [](LobeSet& s) { s.channels = 5000; });
  refused("Lobe 1: alpha", [](LobeSet& s) { s.lobes[1].alpha = 9e-6; });
  refused("Lobe 2: alpha", [](LobeSet& s) { s.lobes[2].alpha = std::nan(""); });
  refused("Lobe 1: f90", [](LobeSet& s) { s.lobes[1].f90 = -0.1; });
  refused("Lobe 0: a colour value", [](LobeSet& s) { s.lobes[0].color[2] = -1e-9; });
  refused("Lobe 0: a colour value", [](LobeSet& s) { s.lobes[0].color[2] = std::numeric_limits<double>::infinity(); });
  refused("Lobe 1: the number of colour values is 2", [](LobeSet& s) { s.lobes[1].color.pop_back(); });
  refused("Lobe 0: kind is 9", [](LobeSet& s) { s.lobes[0].kind = static_cast<LobeKind>(9); });
  refused("GGX lobes is 17", [](LobeSet& s) { s.lobes.assign(17, s.lobes[1]); }, ErrorCode::limit_exceeded);
}

TEST(EvalEdgeCases, GridsThatContradictTheirDefinitionAreRefused) {
  const auto refused = [](const std::string& words, const std::function<void(residual::ResidualGrid&)>& spoil,
                          ErrorCode code = ErrorCode::invalid_argument) {
    residual::ResidualGrid grid = test::synthetic_grid({4, 4, 4, 3, true});
    spoil(grid);
    expect_refused(code, words, [&] { test::material_of(test::usual_lobes(), grid); });
  };
  refused("channels is 2", [](auto& g) { g.channels = 2; });
  refused("nodes is 0", [](auto& g) { g.n_d = 0; });
  refused("nodes is -4", [](auto& g) { g.n_h = -4; });
  refused("kappa", [](auto& g) { g.kappa_h = 0; });
  refused("kappa", [](auto& g) { g.kappa_d = std::numeric_limits<float>::quiet_NaN(); });
  refused("epsilon", [](auto& g) { g.epsilon = -1; });
  refused("number of halves", [](auto& g) { g.ratio.pop_back(); });
  refused("a ratio", [](auto& g) { g.ratio[5] = 0x8400; });
  refused("a ratio", [](auto& g) { g.ratio[191] = 0x03ff; });
  refused("a ratio", [](auto& g) { g.ratio[0] = 0x7c00; });
  refused("number of nodes", [](auto& g) { g.n_h = g.n_d = g.n_p = 60000; }, ErrorCode::limit_exceeded);
}

}  // namespace
