// SPDX-License-Identifier: Apache-2.0
// Whole scores: limits, images, counting, threads, quality.
#include <brdf/error.h>
#include <brdf/metrics.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace {

using namespace brdf;
constexpr double pi = std::numbers::pi;

BatchEval constant(float value) {
  return [value](auto, auto, std::span<float> out) { std::fill(out.begin(), out.end(), value); };
}

/// A glossy stand-in: diffuse plus a lobe of the half vector, three channels, with a ripple of relative size `ripple`.
BatchEval glossy(double ripple) {
  return [ripple](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const double x = static_cast<double>(wi[i].x + wo[i].x), y = static_cast<double>(wi[i].y + wo[i].y);
      const double z = static_cast<double>(wi[i].z + wo[i].z), sin2 = (x * x + y * y) / (x * x + y * y + z * z);
      const double lobe = 3 * std::exp(-sin2 / (2 * 0.1 * 0.1));
      for (std::size_t c = 0; c < 3; ++c) {
        const double wave =
            std::sin(5 * static_cast<double>(wi[i].x) + 4 * static_cast<double>(wo[i].y) + static_cast<double>(c));
        out[3 * i + c] = static_cast<float>((0.3 - 0.1 * static_cast<double>(c) + lobe) * (1 + ripple * wave));
      }
    }
  };
}

void expect_same(const ErrorReport& a, const ErrorReport& b) {
  for (const auto& [x, y] : {std::pair(a.log_mae, b.log_mae), std::pair(a.cbrt_rms, b.cbrt_rms)}) {
    EXPECT_EQ(x.all, y.all);
    EXPECT_EQ(x.band, y.band);
    EXPECT_EQ(x.p95, y.p95);
    EXPECT_EQ(x.max, y.max);
  }
  EXPECT_EQ(a.cos_l2, b.cos_l2);
  EXPECT_EQ(a.psnr_env, b.psnr_env);
  EXPECT_EQ(a.psnr_light, b.psnr_light);
  EXPECT_EQ(a.psnr_lights, b.psnr_lights);
  EXPECT_EQ(a.albedo_error, b.albedo_error);
  EXPECT_EQ(a.not_finite, b.not_finite);
  EXPECT_EQ(a.negative, b.negative);
}

TEST(Comparison, IdenticalFunctionsHaveNoErrorAndCappedPsnr) {
  const ErrorReport r = Comparison(glossy(0), 3, 0.05).score(glossy(0));
  EXPECT_EQ(r.log_mae.all, 0);
  EXPECT_EQ(r.log_mae.max, 0);
  EXPECT_EQ(r.cbrt_rms.all, 0);
  EXPECT_EQ(r.cos_l2, 0);
  EXPECT_EQ(r.albedo_error, 0);
  EXPECT_EQ(r.psnr_env, 60);
  EXPECT_EQ(r.psnr_lights, 60);
  for (const double p : r.psnr_light) EXPECT_EQ(p, 60);
  EXPECT_EQ(r.not_finite, 0u);
  EXPECT_EQ(r.negative, 0u);
}

TEST(Comparison, EveryImageIsCappedBeforeTheMean) {
  // differs only where both directions nearly coincide, as under the light behind the viewer
  const BatchEval retro = [](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const Vec3f d = wi[i] - wo[i];
      out[i] = d.x * d.x + d.y * d.y + d.z * d.z < 1e-6f ? 0.2f : 0.3f;
    }
  };
  const ErrorReport r = Comparison(constant(0.3f), 1, 0.05).score(retro);
  EXPECT_LT(r.psnr_light[0], 30);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(r.psnr_light[k], 60);
  EXPECT_DOUBLE_EQ(r.psnr_lights, (r.psnr_light[0] + 180) / 4);
}

TEST(Comparison, HeadlightPsnrOfLambertMatchesTheFormula) {
  const double d = 0.1;
  const ErrorReport r = Comparison(constant(0.2f), 1).score(constant(static_cast<float>(0.2 * (1 + d))));
  // the headlight image of a Lambertian sphere is proportional to cos = sqrt(1 - x^2 - y^2) on 64 x 64 pixels
  double mean = 0;
  std::vector<double> cosines;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const double u = (x + 0.5) / 32 - 1, v = (y + 0.5) / 32 - 1;
      if (u * u + v * v < 0.98) cosines.push_back(std::sqrt(1 - u * u - v * v));
    }
  for (const double c : cosines) mean += c / static_cast<double>(cosines.size());
  double mse = 0;
  for (const double c : cosines) {
    const double a = std::pow(std::min(1.0, 0.5 * c / mean), 1 / 2.2),
                 b = std::pow(std::min(1.0, 0.5 * c * (1 + d) / mean), 1 / 2.2);
    mse += (a - b) * (a - b) / static_cast<double>(cosines.size());
  }
  EXPECT_NEAR(r.psnr_light[0], -10 * std::log10(mse), 1e-3);
}

TEST(Comparison, AlbedoErrorOfLambertIsTheDifferenceOfReflectances) {
  const auto two = [](double a, double b) -> BatchEval {
    return [a, b](auto, auto, std::span<float> out) {
      for (std::size_t i = 0; i < out.size(); i += 2)
        out[i] = static_cast<float>(a / pi), out[i + 1] = static_cast<float>(b / pi);
    };
  };
  const ErrorReport r = Comparison(two(0.5, 0.8), 2).score(two(0.52, 0.71));
  EXPECT_NEAR(r.albedo_error, 0.09, 2e-4);
}

TEST(Comparison, RowsThatAreNotFiniteCountAsZeroAndAreCounted) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const auto spoiled = [bad](bool keep) -> BatchEval {
      return [bad, keep](std::span<const Vec3f> wi, auto, std::span<float> out) {
        for (std::size_t i = 0; i < wi.size(); ++i) out[i] = wi[i].x > 0.5f ? (keep ? bad : 0.0f) : 0.3f;
      };
    };
    std::atomic<std::uint64_t> rows{0};
    const Comparison c(constant(0.3f), 1, 0.02);
    const ErrorReport a = c.score(spoiled(true)), b = c.score(spoiled(false));
    c.score([&](std::span<const Vec3f> wi, auto, std::span<float> out) {
      for (const Vec3f& w : wi) rows += w.x > 0.5f;
      std::fill(out.begin(), out.end(), 0.0f);
    });
    EXPECT_GT(rows, 0u);
    EXPECT_EQ(a.not_finite, rows);
    EXPECT_EQ(b.not_finite, 0u);
    EXPECT_EQ(a.log_mae.all, b.log_mae.all);
    EXPECT_EQ(a.psnr_env, b.psnr_env);
    EXPECT_EQ(a.albedo_error, b.albedo_error);
    EXPECT_TRUE(std::isfinite(a.cbrt_rms.all));
  }
}

TEST(Comparison, DoesNotDependOnTheNumberOfThreads) {
  const ErrorReport one = Comparison(glossy(0), 3, 0.1, 1).score(glossy(0.1));
  expect_same(one, Comparison(glossy(0), 3, 0.1, 2).score(glossy(0.1)));
  expect_same(one, Comparison(glossy(0), 3, 0.1, 7).score(glossy(0.1)));
}

TEST(Comparison, ATenthOfTheRowsAgreesWithAll) {
  const ErrorReport all = Comparison(glossy(0), 3, 1, 2).score(glossy(0.1));
  const ErrorReport tenth = Comparison(glossy(0), 3, 0.1, 2).score(glossy(0.1));
  EXPECT_NEAR(tenth.log_mae.all / all.log_mae.all, 1, 0.03);
  for (std::size_t b = 0; b < 4; ++b) EXPECT_NEAR(tenth.log_mae.band[b] / all.log_mae.band[b], 1, 0.15) << b;
  EXPECT_NEAR(tenth.log_mae.p95 / all.log_mae.p95, 1, 0.15);
  EXPECT_NEAR(tenth.cbrt_rms.all / all.cbrt_rms.all, 1, 0.03);
  EXPECT_NEAR(tenth.cos_l2 / all.cos_l2, 1, 0.15);
  EXPECT_NEAR(tenth.albedo_error / all.albedo_error, 1, 0.15);
  EXPECT_NEAR(tenth.psnr_env, all.psnr_env, 1.5);
  EXPECT_NEAR(tenth.psnr_lights, all.psnr_lights, 1.5);
}

TEST(Comparison, ThreeEqualChannelsScoreLikeOne) {
  const ErrorReport one = Comparison(constant(0.3f), 1, 0.05).score(constant(0.33f));
  const ErrorReport three = Comparison(constant(0.3f), 3, 0.05).score(constant(0.33f));
  const ErrorReport spectral = Comparison(constant(0.3f), 31, 0.05).score(constant(0.33f));
  EXPECT_NEAR(three.log_mae.all, one.log_mae.all, 1e-9);
  EXPECT_NEAR(spectral.log_mae.all, one.log_mae.all, 1e-9);
  EXPECT_NEAR(three.psnr_lights, one.psnr_lights, 1e-6);
  EXPECT_NEAR(spectral.psnr_env, one.psnr_env, 1e-6);
}

TEST(Comparison, RefusesArgumentsWithoutMeaning) {
  const auto code = [](auto&& make) {
    try {
      make();
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::io;
  };
  EXPECT_EQ(code([] { Comparison c(constant(1), 0); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code([] { Comparison c(constant(1), 3, 0.0); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code([] { Comparison c(constant(1), 3, 1.5); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code([] { Comparison c(constant(1), 3, std::nan("")); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code([] { Comparison c(constant(1), 3, 1.0, 0); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code([] { Comparison c(BatchEval{}, 3); }), ErrorCode::invalid_argument);
  EXPECT_EQ(code([] { Comparison(constant(1), 1, 0.01).score(BatchEval{}); }), ErrorCode::invalid_argument);
}

TEST(Comparison, PassesOnWhatAnEvaluationThrows) {
  const Comparison c(constant(0.3f), 1, 0.02, 3);
  EXPECT_THROW(c.score([](auto, auto, std::span<float>) { throw std::out_of_range("lost"); }), std::out_of_range);
  EXPECT_EQ(c.score(constant(0.3f)).log_mae.all, 0);  // still usable
}

TEST(ErrorReport, MetricsHaveNamesAndDirections) {
  for (const Metric m :
       {Metric::log_mae, Metric::cbrt_rms, Metric::psnr_env, Metric::psnr_lights, Metric::albedo_error})
    EXPECT_EQ(metric_from_string(to_string(m)), m);
  EXPECT_FALSE(metric_from_string("psnr"));
  ErrorReport r;
  r.log_mae.all = 0.002;
  r.cbrt_rms.all = 0.01;
  r.psnr_env = 40;
  r.psnr_lights = 33;
  r.albedo_error = 0.004;
  EXPECT_EQ(r.get(Metric::log_mae), 0.002);
  EXPECT_EQ(r.get(Metric::cbrt_rms), 0.01);
  EXPECT_EQ(r.get(Metric::psnr_env), 40);
  EXPECT_EQ(r.get(Metric::psnr_lights), 33);
  EXPECT_EQ(r.get(Metric::albedo_error), 0.004);
  EXPECT_TRUE(r.meets({Metric::log_mae, 0.002}));
  EXPECT_FALSE(r.meets({Metric::log_mae, 0.0019}));
  EXPECT_TRUE(r.meets({Metric::psnr_env, 40}));
  EXPECT_FALSE(r.meets({Metric::psnr_env, 40.1}));
  EXPECT_TRUE(r.meets({Metric::psnr_lights, 30}));
  EXPECT_FALSE(r.meets({Metric::albedo_error, 0.001}));
  EXPECT_FALSE(r.meets({Metric::albedo_error, std::nan("")}));
}

}  // namespace
