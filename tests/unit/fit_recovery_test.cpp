// SPDX-License-Identifier: Apache-2.0
// Lobes put into a table come out of it again, and no others.
#include "fit_synthetic.h"

#include <brdf/fit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace brdf::fit {
namespace {

const Lobe paint{LobeKind::lambert, 1, 1, {0.3, 0.2, 0.1}};

LobeSet with_coat(double alpha) { return {3, {paint, {LobeKind::ggx, alpha, 1, {0.04, 0.05, 0.06}}}}; }

void expect_alone(const FitResult& r, const Lobe& truth, double tolerance) {
  ASSERT_EQ(r.lobes.lobes.size(), 1U) << r.summary.full();
  const Lobe& found = r.lobes.lobes[0];
  EXPECT_EQ(found.kind, truth.kind);
  for (std::size_t c = 0; c < truth.color.size(); ++c) {
    EXPECT_NEAR(found.color[c], truth.color[c], tolerance * truth.color[c]);
  }
}

TEST(FitRecovery, LambertStaysOneLobe) {
  const FitResult r = fit_lobes(table_of({3, {paint}}));
  expect_alone(r, paint, 1e-4);
  EXPECT_NE(r.summary.stop_reason.find("one Lambert lobe describes"), std::string::npos) << r.summary.stop_reason;
  EXPECT_EQ(std::count_if(r.summary.lobes.begin(), r.summary.lobes.end(), [](const auto& l) { return l.kept; }), 1);
}

TEST(FitRecovery, NoiseBuysNoLobes) {
  const FitResult r = fit_lobes(table_of({3, {paint}}, 1, 0.03));
  expect_alone(r, paint, 0.01);
  EXPECT_NE(r.summary.stop_reason.find("one Lambert lobe describes"), std::string::npos) << r.summary.stop_reason;
}

TEST(FitRecovery, CoatComesBackWithItsRoughness) {
  for (const double alpha : {0.02, 0.05, 0.12, 0.35, 0.6}) {
    for (const double noise : {0.0, 0.03}) {
      const FitResult r = fit_lobes(table_of(with_coat(alpha), 1, noise));
      ASSERT_EQ(r.lobes.lobes.size(), 2U) << "alpha " << alpha << " noise " << noise << "\n" << r.summary.full();
      EXPECT_EQ(r.lobes.lobes[0].kind, LobeKind::lambert);
      EXPECT_EQ(r.lobes.lobes[1].kind, LobeKind::ggx);
      EXPECT_NEAR(r.lobes.lobes[1].alpha, alpha, 0.02 * alpha);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(r.lobes.lobes[0].color[c], paint.color[c], 0.02 * paint.color[c]);
        EXPECT_NEAR(r.lobes.lobes[1].color[c], 0.04 + 0.01 * static_cast<double>(c), 0.004);
      }
      EXPECT_NEAR(r.lobes.lobes[1].f90, 1, 0.1);
      const std::string text = r.summary.full();
      EXPECT_NE(text.find("ggx alpha "), std::string::npos);
      EXPECT_NE(text.find(": BIC fell from "), std::string::npos);
    }
  }
}

TEST(FitRecovery, MetalNeedsNoLambert) {
  const LobeSet truth{3, {{LobeKind::ggx, 0.15, 1, {0.9, 0.6, 0.3}}}};
  for (const int max_lobes : {1, 4}) {
    FitOptions o;
    o.max_lobes = max_lobes;
    const FitResult r = fit_lobes(table_of(truth), o);
    expect_alone(r, truth.lobes[0], 0.02);
    EXPECT_NEAR(r.lobes.lobes[0].alpha, 0.15, 0.003);
  }
}

TEST(FitRecovery, TwoCoatsOverPaint) {
  LobeSet truth = with_coat(0.05);
  truth.lobes.push_back({LobeKind::ggx, 0.4, 1, {0.3, 0.2, 0.2}});
  const FitResult r = fit_lobes(table_of(truth));
  ASSERT_EQ(r.lobes.lobes.size(), 3U) << r.summary.full();
  EXPECT_NEAR(r.lobes.lobes[1].alpha, 0.4, 0.012);
  EXPECT_NEAR(r.lobes.lobes[2].alpha, 0.05, 0.0015);
}

TEST(FitRecovery, RetroPeakGetsARetroLobe) {
  const LobeSet truth{3, {paint, {LobeKind::retro_ggx, 0.1, 1, {0.5, 0.4, 0.2}}}};
  const FitResult r = fit_lobes(table_of(truth));
  ASSERT_EQ(r.lobes.lobes.size(), 2U) << r.summary.full();
  EXPECT_EQ(r.lobes.lobes[1].kind, LobeKind::retro_ggx);
  EXPECT_NEAR(r.lobes.lobes[1].alpha, 0.1, 0.005);

  FitOptions o;
  o.retro = false;
  for (const Lobe& lobe : fit_lobes(table_of(truth), o).lobes.lobes) EXPECT_NE(lobe.kind, LobeKind::retro_ggx);
}

TEST(FitRecovery, ScaleOfTheTableIsIrrelevant) {
  const FitResult one = fit_lobes(table_of(with_coat(0.12)));
  for (const double scale : {1e-30, 1e30}) {
    const FitResult r = fit_lobes(table_of(with_coat(0.12), scale));
    ASSERT_EQ(r.lobes.lobes.size(), 2U) << scale << "\n" << r.summary.full();
    EXPECT_NEAR(r.lobes.lobes[1].alpha, one.lobes.lobes[1].alpha, 1e-4);
    EXPECT_NEAR(r.lobes.lobes[1].f90 / scale, one.lobes.lobes[1].f90, 1e-3);
    EXPECT_NEAR(r.lobes.lobes[0].color[1] / scale, one.lobes.lobes[0].color[1], 1e-4);
  }
}

TEST(FitRecovery, ChannelWithoutLightStaysBlack) {
  LobeSet truth = with_coat(0.2);
  truth.lobes[0].color[2] = 0;
  const FitResult r = fit_lobes(table_of(truth));
  ASSERT_EQ(r.lobes.lobes.size(), 2U) << r.summary.full();
  EXPECT_EQ(r.lobes.lobes[0].color[2], 0);
  EXPECT_NEAR(r.lobes.lobes[0].color[0], 0.3, 0.006);
}

TEST(FitRecovery, ManyChannelsKeepTheirOwnColors) {
  for (const int channels : {1, 2, 4, 31, 195}) {
    LobeSet truth{channels, {{LobeKind::lambert, 1, 1, {}}, {LobeKind::ggx, 0.15, 1, {}}}};
    for (int c = 0; c < channels; ++c) {
      truth.lobes[0].color.push_back(0.2 + 0.1 * std::sin(0.3 * c));
      truth.lobes[1].color.push_back(0.05 + 0.02 * std::cos(0.2 * c));
    }
    FitOptions o;
    o.samples = 2000;
    const FitResult r = fit_lobes(table_of(truth), o);
    ASSERT_EQ(r.lobes.channels, channels);
    ASSERT_EQ(r.lobes.lobes.size(), 2U) << r.summary.full();
    EXPECT_NEAR(r.lobes.lobes[1].alpha, 0.15, 0.003);
    for (std::size_t l = 0; l < 2; ++l) {
      ASSERT_EQ(r.lobes.lobes[l].color.size(), static_cast<std::size_t>(channels));
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
        EXPECT_NEAR(r.lobes.lobes[l].color[c], truth.lobes[l].color[c], 0.03 * truth.lobes[l].color[c] + 0.002);
      }
    }
  }
}

}  // namespace
}  // namespace brdf::fit
