// SPDX-License-Identifier: Apache-2.0
#include "test_pairs.h"

#include "counter_random.h"

#include <array>
#include <cmath>
#include <numbers>

namespace brdf::cli {
namespace {

constexpr double pi = std::numbers::pi;

Vec3f direction(double cos_theta, double phi) noexcept {
  const double sine = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  return Vec3f(Vec3d(sine * std::cos(phi), sine * std::sin(phi), cos_theta));
}

}  // namespace

TestPairs random_pairs(std::size_t count, std::uint64_t seed) {
  const CounterRandom random(seed);
  TestPairs pairs{DirectionPlanes(count), DirectionPlanes(count)};
  const auto draw = [&](std::size_t i, std::uint64_t dimension) {
    // 1 - u is in (0, 1]: never on the horizon
    return direction(1 - static_cast<double>(random.uniform(i, dimension)),
                     2 * pi * static_cast<double>(random.uniform(i, dimension + 1)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    pairs.wi.set(i, draw(i, 0));
    pairs.wo.set(i, draw(i, 2));
  }
  return pairs;
}

TestPairs make_test_pairs() {
  constexpr std::array cosines{1.0,  1 - 1e-7, 0.9999, 0.99,  0.9,   0.7, 0.5,   0.3,  0.1,  0.05, 0.01,
                               1e-3, 1e-5,     1e-7,   1e-20, 1e-38, 0.0, -1e-7, -0.1, -0.5, -1.0};
  constexpr std::array azimuths{0.0, 1e-7, 1e-3, 0.1, 0.5 * pi, 2.0, pi - 1e-3, pi, -0.7};
  constexpr std::size_t spread = 4096;
  const TestPairs random = random_pairs(spread, 20);
  TestPairs pairs{DirectionPlanes(cosines.size() * cosines.size() * azimuths.size() + spread), DirectionPlanes()};
  pairs.wo.resize(pairs.wi.size());
  std::size_t k = 0;
  for (const double a : cosines) {
    for (const double b : cosines) {
      for (const double phi : azimuths) {
        pairs.wi.set(k, direction(a, 0.4 + phi));
        pairs.wo.set(k, direction(b, 0.4));
        ++k;
      }
    }
  }
  for (std::size_t i = 0; i < spread; ++i, ++k) {
    const Vec3f wi = random.wi.get(i), wo = random.wo.get(i);
    const float side = i % 8 == 7 ? -1.0F : 1.0F;
    pairs.wi.set(k, {wi.x, wi.y, side * wi.z});
    pairs.wo.set(k, wo);
  }
  return pairs;
}

}  // namespace brdf::cli
