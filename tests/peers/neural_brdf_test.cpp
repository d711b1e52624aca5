// SPDX-License-Identifier: Apache-2.0
// The network's kernels against its definition, and the published networks against figures of another implementation.
#include "peers/neural_brdf.h"
#include "peers/npz_file.h"

#include "support/data_folders.h"
#include "support/direction_batch.h"
#include "support/expect_error.h"
#include "support/simd_targets.h"

#include <brdf/ingest.h>
#include <brdf/metrics.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <vector>

namespace brdf {
namespace {

using peers::Azimuth;
using peers::NeuralBrdf;

std::vector<float> random_weights() {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(0, 0.4F);
  std::vector<float> weights(NeuralBrdf::weight_count);
  for (float& w : weights) w = normal(random);
  return weights;
}

/// By angles and in double.
std::array<double, 3> defined_value(const std::vector<float>& weights, Azimuth azimuth, const Vec3d& wi,
                                    const Vec3d& wo) {
  constexpr double pi = std::numbers::pi;
  const Vec3d s = wi + wo;
  const double theta_h = std::atan2(std::hypot(s.x, s.y), s.z), phi_h = std::atan2(s.y, s.x);
  const double x = std::cos(phi_h) * wi.x + std::sin(phi_h) * wi.y, y = std::cos(phi_h) * wi.y - std::sin(phi_h) * wi.x;
  const double dx = std::cos(theta_h) * x - std::sin(theta_h) * wi.z,
               dz = std::sin(theta_h) * x + std::cos(theta_h) * wi.z;
  const double theta_d = std::atan2(std::hypot(dx, y), dz);
  double phi_d = std::atan2(y, dx);
  if (azimuth == Azimuth::full_circle)
    phi_d += pi;
  else if (phi_d < 0)
    phi_d += pi;
  std::vector<double> in{
      std::sin(theta_h), 0, std::cos(theta_h), std::sin(theta_d) * std::cos(phi_d), std::sin(theta_d) * std::sin(phi_d),
      std::cos(theta_d)};
  std::size_t at = 0;
  for (const std::size_t m : {21U, 21U, 3U}) {
    std::vector<double> out(m);
    for (std::size_t j = 0; j < m; ++j) {
      out[j] = weights[at + in.size() * m + j];
      for (std::size_t k = 0; k < in.size(); ++k) out[j] += in[k] * weights[at + k * m + j];
      if (m != 3) out[j] = std::max(out[j], 0.0);
    }
    at += in.size() * m + m;
    in = out;
  }
  return {std::max(std::expm1(in[0]), 0.0), std::max(std::expm1(in[1]), 0.0), std::max(std::expm1(in[2]), 0.0)};
}

TEST(NeuralBrdf, BatchAndSinglePairsFollowTheDefinition) {
  constexpr std::size_t pairs = 1003;  // no whole number of vectors
  const test::DirectionBatch wi = test::random_directions(pairs, 1), wo = test::random_directions(pairs, 2);
  const std::vector<float> weights = random_weights();
  for (const Azimuth azimuth : {Azimuth::full_circle, Azimuth::half_circle}) {
    const NeuralBrdf network(weights, azimuth);
    test::on_every_target([&] {
      std::vector<float> f(3 * pairs, -1.0F);
      network.eval(wi.span(), wo.span(), {f.data(), pairs});
      for (std::size_t i = 0; i < pairs; ++i) {
        const auto expected = defined_value(weights, azimuth, Vec3d(wi[i]), Vec3d(wo[i]));
        std::array<float, 3> single{};
        network.eval(wi[i], wo[i], std::span<float, 3>(single));
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(f[c * pairs + i], expected[c], 1e-4 * (1 + expected[c])) << i;
          EXPECT_NEAR(single[c], expected[c], 1e-4 * (1 + expected[c])) << i;
        }
      }
    });
  }
}

TEST(NeuralBrdf, IsNothingBelowTheHorizon) {
  const NeuralBrdf network(random_weights(), Azimuth::full_circle);
  std::array<float, 3> f{1, 1, 1};
  network.eval({0, 0, 1}, {0, 0.6F, -0.8F}, std::span<float, 3>(f));
  EXPECT_EQ(f, (std::array<float, 3>{}));
}

TEST(NeuralBrdf, RefusesOtherWeights) {
  std::vector<float> weights = random_weights();
  weights.pop_back();
  test::expect_error(ErrorCode::invalid_argument, {"674", "675"}, [&] { NeuralBrdf(weights, Azimuth::half_circle); });
  weights.push_back(std::nanf(""));
  test::expect_error(ErrorCode::invalid_argument, {"finite"}, [&] { NeuralBrdf(weights, Azimuth::half_circle); });
}

/// PSNR and log_mae that a numpy implementation of network and metrics gives for the same material.
struct Figures {
  const char* material;
  double psnr_env, psnr_lights, log_mae;
};

TEST(NeuralBrdf, SlowSharedDataFiguresAgreeWithAnotherImplementation) {
  const auto data = test::shared_folder() / "data";
  if (!std::filesystem::exists(data / "models" / "nbrdf_rgl.npz")) GTEST_SKIP() << data << " is absent";
  const peers::NpzFile networks(data / "models" / "nbrdf_rgl.npz");
  for (const Figures& known :
       {Figures{"paper_white", 53.4, 38.9, 0.0031}, Figures{"irid_flake_paint1", 31.0, 18.4, 0.0020}}) {
    const auto weights = networks.floats(known.material);
    ASSERT_TRUE(weights);
    const NeuralBrdf network(*weights, Azimuth::full_circle);
    const Measurement m = read_measurement(data / "rgl" / (std::string(known.material) + "_rgb.bsdf"));
    const MeasurementInterpolator interpolator(m);
    const auto reference = [&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
      std::array<double, 3> f{};
      for (std::size_t i = 0; i < wi.size(); ++i) {
        interpolator.eval(Vec3d(wi[i]), Vec3d(wo[i]), f);
        for (std::size_t c = 0; c < 3; ++c) out[3 * i + c] = static_cast<float>(f[c]);
      }
    };
    const auto candidate = [&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
      for (std::size_t i = 0; i < wi.size(); ++i) network.eval(wi[i], wo[i], out.subspan(3 * i).first<3>());
    };
    const ErrorReport errors = Comparison(reference, 3).score(candidate);
    EXPECT_NEAR(errors.psnr_env, known.psnr_env, 0.1) << known.material;
    EXPECT_NEAR(errors.psnr_lights, known.psnr_lights, 0.1) << known.material;
    EXPECT_NEAR(errors.log_mae.all, known.log_mae, 0.05 * known.log_mae + 5e-5) << known.material;
  }
}

}  // namespace
}  // namespace brdf
