// SPDX-License-Identifier: Apache-2.0
// What a process that lives for weeks does, for BRDF_SOAK_SECONDS (30 without it): tables come in, files go out and are read by
// many threads, and memory must not creep.
#include "support/small_measurement.h"

#include <brdf/encode.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

namespace brdf {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration soak_time() {
  const char* text = std::getenv("BRDF_SOAK_SECONDS");
  return std::chrono::seconds(text != nullptr ? std::max(1, std::atoi(text)) : 30);
}

double resident_megabytes() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// A coat over a body, each time another one, with a few per cent of noise.
Measurement random_table(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> noise(0, 0.02);
  LobeSet lobes;
  Lobe body, coat;
  body.kind = LobeKind::lambert;
  coat.kind = LobeKind::ggx;
  coat.alpha = static_cast<float>(std::exp(-3 * uniform(random)) * 0.6);
  for (int c = 0; c < 3; ++c) {
    body.color.push_back(static_cast<float>(0.3 * uniform(random)));
    coat.color.push_back(static_cast<float>(0.04 + 0.5 * uniform(random)));
  }
  lobes.lobes = {body, coat};
  return test::small_measurement({24, 12, 16, uniform(random) < 0.5}, 3, [&](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    eval_lobes(lobes, wi, wo, f);
    for (double& v : f) v *= std::exp(noise(random));
  });
}

Vec3f random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  const Vec3f v{normal(random), normal(random), std::abs(normal(random)) + 1e-3f};
  const float length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return {v.x / length, v.y / length, v.z / length};
}

/// Sum over many pairs and samples: any thread must get the same bits.
double digest(const Material& material, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  double sum = 0;
  float f[3];
  for (int i = 0; i < 300; ++i) {
    const Vec3f wi = random_direction(random), wo = random_direction(random);
    material.eval(wi, wo, f);
    const Sample s = material.sample(wo, {uniform(random), uniform(random), uniform(random)}, f);
    sum += static_cast<double>(f[0]) + static_cast<double>(f[1]) + static_cast<double>(s.pdf) +
           static_cast<double>(material.pdf(wi, wo));
  }
  return sum;
}

TEST(LongRun, EncodesDecodesAndReadersLeaveNothingBehind) {
  std::mt19937 random(20);
  const Clock::time_point start = Clock::now(), end = start + soak_time();
  constexpr int warm_up = 8;
  double settled = 0;
  int rounds = 0;
  for (; rounds <= 2 * warm_up || Clock::now() < end; ++rounds) {
    const Measurement table = random_table(random);
    EncodeOptions options;
    options.effort = rounds % 3 == 0 ? 25 : 0;
    options.target_size = 200 + 100 * (rounds % 9);
    const EncodeResult encoded = compress(table, options);
    ASSERT_LE(encoded.bytes.size(), *options.target_size);
    const Material material = Material::decode(encoded.bytes);
    const double expected = digest(material, 1);
    ASSERT_TRUE(std::isfinite(expected));
    std::atomic<int> wrong{0};
    std::vector<std::thread> readers;
    for (int t = 0; t < 3; ++t)
      readers.emplace_back([&, t] {
        for (int i = 0; i < 3; ++i) {
          const Material own = t == 0 ? Material::decode(encoded.bytes) : material;
          if (digest(own, 1) != expected) ++wrong;
        }
      });
    for (std::thread& reader : readers) reader.join();
    ASSERT_EQ(wrong, 0);
    if (rounds == warm_up) settled = resident_megabytes();
  }
  // one round touches some 30 MB, so that a leak of one percent a round would show within the usual hundred rounds
  EXPECT_LT(resident_megabytes(), settled + 30) << "after " << rounds << " rounds";
  RecordProperty("rounds", rounds);
}

}  // namespace
}  // namespace brdf
