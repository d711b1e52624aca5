// SPDX-License-Identifier: Apache-2.0
// The noise floor of a comparison, on noise whose variance is known.
#include "image/comparison.h"
#include "image/differences.h"
#include "image/metric_pictures.h"
#include "support/expect_error.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace brdf::render {
namespace {

using test::expect_error;

/// Renders of a flat grey scene: each pixel is level + shared noise + own noise, the former common to reference and candidate.
struct Renders {
  Image reference, candidate;
  NoisePair noise;
};

Renders renders(unsigned seed, float shared_deviation, float own_deviation, float darker) {
  constexpr int side = 64;
  constexpr float level = 0.5F;
  std::mt19937 generator(seed);
  std::normal_distribution<float> unit(0, 1);
  Renders r{Image(side, side), Image(side, side), {Image(side, side), Image(side, side), Image(side, side), Image(side, side)}};
  for (std::size_t i = 0; i < r.reference.pixels.size(); ++i) {
    for (auto [reference, candidate] : {std::pair(&r.noise.reference_a, &r.noise.candidate_a), std::pair(&r.noise.reference_b, &r.noise.candidate_b)}) {
      const float shared = shared_deviation * unit(generator);
      for (int c = 0; c < 3; ++c) {
        reference->pixels[i][c] = level + shared + own_deviation * unit(generator);
        candidate->pixels[i][c] = level - darker + shared + own_deviation * unit(generator);
      }
    }
    r.reference.pixels[i] = 0.5F * (r.noise.reference_a.pixels[i] + r.noise.reference_b.pixels[i]);
    r.candidate.pixels[i] = 0.5F * (r.noise.candidate_a.pixels[i] + r.noise.candidate_b.pixels[i]);
  }
  return r;
}

double mean_square(const Image& image) {
  double sum = 0;
  for (const Vec3f& pixel : image.pixels) sum += static_cast<double>(glm::dot(pixel, pixel));
  return sum / (3 * static_cast<double>(image.pixels.size()));
}

TEST(NoiseFloor, IsTheVarianceOfTheMeanOfTheHalves) {
  constexpr float own = 0.04F;
  const Renders r = renders(1, 0, own, 0);
  // Reference and candidate are each the mean of two halves, so the variance of their difference is 2 * own^2 / 2. There are
  // 12288 values: the estimate's relative deviation is sqrt(2 / 12288) = 1.3 %.
  const double expected = static_cast<double>(own) * static_cast<double>(own);
  EXPECT_NEAR(mean_square(noise_of_difference(r.noise)) / expected, 1, 5 * 0.013);
  EXPECT_NEAR(mean_square(difference(r.reference, r.candidate)) / expected, 1, 5 * 0.013);
}

TEST(NoiseFloor, WhatCommonRandomNumbersCancelIsNotInIt) {
  constexpr float own = 0.001F;
  const Renders r = renders(2, 0.2F, own, 0);
  const double expected = static_cast<double>(own) * static_cast<double>(own);
  EXPECT_NEAR(mean_square(noise_of_difference(r.noise)) / expected, 1, 5 * 0.013);
  const ComparisonResult result = compare_images(r.reference, r.candidate, r.noise);
  EXPECT_LT(*result.flip.floor, 0.02);  // noise of 0.2 in each picture would give a third
}

TEST(NoiseFloor, EachFigureOfNoiseAloneIsItsFloor) {
  const Renders r = renders(3, 0.05F, 0.02F, 0);
  const ComparisonResult result = compare_images(r.reference, r.candidate, r.noise);
  EXPECT_NEAR(result.psnr.value, *result.psnr.floor, 0.3);
  EXPECT_NEAR(1 - result.ssim.value, 1 - *result.ssim.floor, 0.05 * (1 - *result.ssim.floor));
  EXPECT_NEAR(result.flip.value, *result.flip.floor, 0.05 * *result.flip.floor);
  EXPECT_NEAR(result.hdr_flip.value, *result.hdr_flip.floor, 0.05 * *result.hdr_flip.floor);
  EXPECT_NEAR(result.relative_mse.value, *result.relative_mse.floor, 0.07 * *result.relative_mse.floor);
  EXPECT_NEAR(result.mse.value, *result.mse.floor, 0.07 * *result.mse.floor);
  EXPECT_NEAR(result.mean_absolute.value, *result.mean_absolute.floor, 0.05 * *result.mean_absolute.floor);
  EXPECT_NEAR(result.max_difference.value, *result.max_difference.floor, 0.35 * *result.max_difference.floor);
}

TEST(NoiseFloor, WhatRemainsWithoutNoiseIsUnbiasedAndKnowsItsDeviation) {
  // Over many renders: the mean of the estimates is the truth, and estimate / deviation has variance 1 where the truth is 0.
  constexpr int count = 100;
  constexpr float darker = 0.01F;
  double sum_z = 0, sum_z2 = 0, sum_mean_z2 = 0, sum_estimate = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    const Renders same = renders(100 + seed, 0.05F, 0.02F, 0);
    const Image noise = noise_of_difference(same.noise), d = difference(same.reference, same.candidate);
    const WithoutNoise nothing = squares_without_noise(d, noise);
    sum_z += nothing.value / nothing.deviation;
    sum_z2 += nothing.value / nothing.deviation * nothing.value / nothing.deviation;
    const double mean_z = radiance_difference(same.reference, same.candidate).mean_signed / deviation_of_mean(noise);
    sum_mean_z2 += mean_z * mean_z;
    const Renders less = renders(500 + seed, 0.05F, 0.02F, darker);
    sum_estimate += squares_without_noise(difference(less.reference, less.candidate), noise_of_difference(less.noise)).value;
  }
  EXPECT_LT(std::abs(sum_z) / count, 4 / std::sqrt(static_cast<double>(count)));
  EXPECT_NEAR(sum_z2 / count, 1, 4 * std::sqrt(2.0 / count));
  EXPECT_NEAR(sum_mean_z2 / count, 1, 4 * std::sqrt(2.0 / count));
  // One estimate has a deviation of 8 % of the truth, their mean 0.8 %; the noise is four times the truth.
  EXPECT_NEAR(sum_estimate / count / (static_cast<double>(darker) * static_cast<double>(darker)), 1, 4 * 0.008);
}

TEST(NoiseFloor, WeightsCountPerChannel) {
  Image d(1, 1), n(1, 1), weight(1, 1);
  d.at(0, 0) = {3, 2, 1};
  n.at(0, 0) = {1, 0, 2};
  weight.at(0, 0) = {0.5F, 1, 2};
  const WithoutNoise result = squares_without_noise(d, n, weight);
  EXPECT_DOUBLE_EQ(result.value, (0.5 * 8 + 4 - 2 * 3) / 3);
  EXPECT_DOUBLE_EQ(result.deviation, 2.0 / 3);
}

TEST(NoiseFloor, ARealDifferenceStandsAboveIt) {
  const Renders r = renders(4, 0.05F, 0.02F, 0.03F);
  const ComparisonResult result = compare_images(r.reference, r.candidate, r.noise);
  EXPECT_LT(result.psnr.value, *result.psnr.floor - 3);
  EXPECT_GT(result.flip.value, 1.2 * *result.flip.floor);
  EXPECT_GT(result.relative_mse_without_noise->value, 10 * result.relative_mse_without_noise->deviation);
  EXPECT_NEAR(result.mse_without_noise->value, 0.0009, 4 * result.mse_without_noise->deviation);
  EXPECT_GT(result.displayed_mse_without_noise->value, 10 * result.displayed_mse_without_noise->deviation);
  EXPECT_NEAR(result.mean_signed, -0.03, 5 * *result.mean_signed_deviation);
  EXPECT_LT(*result.mean_signed_deviation, 0.001);
}

TEST(Comparison, WithoutHalvesThereAreFiguresAndNoFloors) {
  const test::MetricPictures p = test::metric_pictures();
  const ComparisonResult result = compare_images(p.reference, p.candidate, std::nullopt, 0);
  EXPECT_NEAR(result.flip.value, 0.13250431418418884, 1e-5);
  EXPECT_NEAR(result.flip.value, mean(result.flip_map), 1e-12);
  EXPECT_FALSE(result.flip.floor || result.psnr.floor || result.mean_signed_deviation || result.relative_mse_without_noise);
  EXPECT_LT(result.mean_signed, 0);
}

TEST(Comparison, HalvesOfAnotherSizeAreRefused) {
  Renders r = renders(5, 0, 0.1F, 0);
  const Renders whole = r;
  r.noise.candidate_b = Image(64, 63);
  expect_error(ErrorCode::invalid_argument, {"64 x 63"}, [&] { compare_images(whole.reference, whole.candidate, r.noise); });
  const Image small(32, 32);
  expect_error(ErrorCode::invalid_argument, {"32 x 32"}, [&] { compare_images(small, small, whole.noise); });
}

}  // namespace
}  // namespace brdf::render
