// SPDX-License-Identifier: Apache-2.0
// Metrics against the values of their authors' programs, and what must hold for all pictures.
#include "image/differences.h"
#include "image/display.h"
#include "image/flip.h"
#include "image/metric_pictures.h"
#include "image/ssim.h"
#include "support/expect_error.h"

#include <algorithm>
#include <random>

namespace brdf::render {
namespace {

using test::expect_error;
using test::metric_pictures;
using test::MetricPictures;

/// Uniform noise of a given amplitude on a picture, the same pattern for every amplitude.
Image with_noise(const Image& image, float amplitude) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<float> uniform(-amplitude, amplitude);
  Image noisy = image;
  for (Vec3f& pixel : noisy.pixels) {
    for (int c = 0; c < 3; ++c) pixel[c] = std::max(0.0F, pixel[c] + uniform(generator));
  }
  return noisy;
}

Image scaled(Image image, float factor) {
  for (Vec3f& pixel : image.pixels) pixel *= factor;
  return image;
}

float largest(const Plane& plane) { return *std::max_element(plane.values.begin(), plane.values.end()); }

// The golden values below are what tests/support/metric_pictures.py printed (its first lines tell how to run it) with
// flip-evaluator 1.7 and scikit-image 0.26.0. tests/cli/image_peers.py compares with them anew where they are installed.
TEST(ImageMetrics, PsnrAndSsimAreScikitImages) {
  const MetricPictures p = metric_pictures();
  EXPECT_NEAR(psnr(p.reference, p.candidate, 0), 25.13783861790269, 1e-6);
  EXPECT_NEAR(ssim(p.reference, p.candidate, 0), 0.8624173588199551, 1e-6);
}

TEST(ImageMetrics, FlipIsNvidias) {
  const MetricPictures p = metric_pictures();
  const Plane map = flip(p.reference, p.candidate);
  EXPECT_NEAR(mean(map), 0.13250431418418884, 1e-5);
  EXPECT_NEAR(largest(map), 0.37984925508499146, 1e-4);
  EXPECT_NEAR(map.at(70, 20), 0.03599829599261284, 1e-4);
  EXPECT_NEAR(map.at(10, 5), 0.06888488680124283, 1e-4);
  EXPECT_NEAR(mean(flip(p.reference, p.candidate, 30)), 0.16629821062088013, 1e-5);
}

TEST(ImageMetrics, HdrFlipIsNvidias) {
  const MetricPictures p = metric_pictures();
  const FlipExposures exposures = flip_exposures(p.reference);
  EXPECT_NEAR(exposures.start, -4.2010016441345215, 1e-5);
  EXPECT_NEAR(exposures.stop, 4.819520473480225, 1e-5);
  EXPECT_EQ(exposures.count, 10);
  const Plane map = hdr_flip(p.reference, p.candidate);
  EXPECT_NEAR(mean(map), 0.16701863706111908, 1e-5);
  EXPECT_NEAR(largest(map), 0.3781641125679016, 1e-4);
  EXPECT_NEAR(map.at(10, 5), 0.1251700222492218, 1e-4);
}

TEST(ImageMetrics, EqualPicturesDoNotDiffer) {
  const Image image = metric_pictures().reference;
  EXPECT_EQ(psnr(image, image, 0), psnr_cap);
  EXPECT_NEAR(ssim(image, image, 0), 1, 1e-12);
  EXPECT_EQ(largest(flip(image, image)), 0);
  EXPECT_EQ(largest(hdr_flip(image, image)), 0);
  EXPECT_EQ(relative_mse(image, image, 0), 0);
  const RadianceDifference difference = radiance_difference(image, image);
  EXPECT_EQ(difference.max_absolute, 0);
  EXPECT_EQ(difference.mean_absolute, 0);
  EXPECT_EQ(difference.mean_signed, 0);
}

TEST(ImageMetrics, BlackAgainstBlackAndWhite) {
  const Image black(16, 16);
  Image white(16, 16);
  for (Vec3f& pixel : white.pixels) pixel = Vec3f(1);
  EXPECT_EQ(largest(hdr_flip(black, black)), 0);
  EXPECT_NEAR(psnr(black, white, 0), 0, 1e-9);
  const Plane map = flip(black, white);
  EXPECT_GT(mean(map), 0.95);  // 0.966 by the paper's own figure 4 of the largest lightness difference
  EXPECT_LE(largest(map), 1);
}

TEST(ImageMetrics, OrderOfThePicturesDoesNotMatterWhereItShouldNot) {
  const MetricPictures p = metric_pictures();
  EXPECT_EQ(flip(p.reference, p.candidate).values, flip(p.candidate, p.reference).values);
  EXPECT_DOUBLE_EQ(psnr(p.reference, p.candidate, 0), psnr(p.candidate, p.reference, 0));
  EXPECT_NEAR(ssim(p.reference, p.candidate, 0), ssim(p.candidate, p.reference, 0), 1e-9);
  EXPECT_DOUBLE_EQ(radiance_difference(p.reference, p.candidate).mean_signed,
                   -radiance_difference(p.candidate, p.reference).mean_signed);
}

TEST(ImageMetrics, MoreNoiseIsWorseByEveryMetric) {
  const Image image = metric_pictures().reference;
  double last_psnr = psnr_cap, last_ssim = 1, last_flip = 0, last_hdr = 0, last_relative = 0, last_max = 0;
  for (const float amplitude : {0.002F, 0.01F, 0.04F, 0.15F}) {
    const Image noisy = with_noise(image, amplitude);
    const auto falls = [](double& last, double now) { EXPECT_LT(now, last); last = now; };
    const auto rises = [](double& last, double now) { EXPECT_GT(now, last); last = now; };
    falls(last_psnr, psnr(image, noisy, 0));
    falls(last_ssim, ssim(image, noisy, 0));
    rises(last_flip, mean(flip(image, noisy)));
    rises(last_hdr, mean(hdr_flip(image, noisy)));
    rises(last_relative, relative_mse(image, noisy, 0));
    rises(last_max, radiance_difference(image, noisy).max_absolute);
  }
}

TEST(ImageMetrics, KnownDifferencesGiveTheirFormulas) {
  Image grey(16, 12);
  for (Vec3f& pixel : grey.pixels) pixel = Vec3f(0.4F);
  const Image darker = scaled(grey, 0.5F);
  EXPECT_NEAR(relative_mse(grey, darker, 0), 0.04 / (0.16 + 0.01), 1e-6);
  EXPECT_NEAR(relative_mse(grey, darker, 1), 0.16 / (0.64 + 0.01), 1e-6);
  const RadianceDifference difference = radiance_difference(grey, darker);
  EXPECT_NEAR(difference.mean_signed, -0.2, 1e-6);
  EXPECT_NEAR(difference.mean_absolute, 0.2, 1e-6);
  EXPECT_NEAR(difference.max_absolute, 0.2, 1e-6);
  // sRGB shows 0.4 as 0.665185 and 0.2 as 0.484529
  EXPECT_NEAR(psnr(grey, darker, 0), -20 * std::log10(0.665185 - 0.484529), 1e-4);
}

TEST(ImageMetrics, ExposureIsAFactorBeforeTheDisplay) {
  const MetricPictures p = metric_pictures();
  const Image r = scaled(p.reference, 4), c = scaled(p.candidate, 4);
  EXPECT_NEAR(psnr(p.reference, p.candidate, 2), psnr(r, c, 0), 1e-9);
  EXPECT_NEAR(ssim(p.reference, p.candidate, 2), ssim(r, c, 0), 1e-9);
  EXPECT_NEAR(relative_mse(p.reference, p.candidate, 2), relative_mse(r, c, 0), 1e-9);
  // HDR-FLIP looks for its exposures itself
  EXPECT_NEAR(mean(hdr_flip(p.reference, p.candidate)), mean(hdr_flip(r, c)), 1e-5);
}

TEST(ImageMetrics, SizesMustAgree) {
  const Image a(16, 16), b(17, 16);
  expect_error(ErrorCode::invalid_argument, {"16 x 16", "17 x 16"}, [&] { (void)psnr(a, b, 0); });
  expect_error(ErrorCode::invalid_argument, {"16 x 16", "17 x 16"}, [&] { (void)ssim(a, b, 0); });
  expect_error(ErrorCode::invalid_argument, {"16 x 16", "17 x 16"}, [&] { flip(a, b); });
  expect_error(ErrorCode::invalid_argument, {"16 x 16", "17 x 16"}, [&] { hdr_flip(a, b); });
  expect_error(ErrorCode::invalid_argument, {"16 x 16", "17 x 16"}, [&] { (void)relative_mse(a, b, 0); });
  expect_error(ErrorCode::invalid_argument, {"16 x 16", "17 x 16"}, [&] { radiance_difference(a, b); });
  expect_error(ErrorCode::invalid_argument, {"without pixels"}, [&] { flip(Image(), Image()); });
  expect_error(ErrorCode::invalid_argument, {"11 x 11"}, [&] { (void)ssim(Image(10, 20), Image(10, 20), 0); });
}

TEST(Filtered, RepeatsTheBorderAndCorrelates) {
  Plane plane(4, 2);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = static_cast<float>(i * i);
  const std::vector<float> left{1, 0, 0}, down{0, 0, 1}, self{1};
  const Plane shifted = filtered(plane, left, self);
  EXPECT_EQ(shifted.values, (std::vector<float>{0, 0, 1, 4, 16, 16, 25, 36}));
  EXPECT_EQ(filtered(plane, self, down).values, (std::vector<float>{16, 25, 36, 49, 16, 25, 36, 49}));
}

}  // namespace
}  // namespace brdf::render
