// SPDX-License-Identifier: Apache-2.0
// Planes of directions or random numbers, and fixed ways to fill them.
#pragma once

#include <brdf/direction.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace brdf::test {

struct DirectionBatch {
  std::vector<float> x, y, z;

  DirectionBatch() = default;
  explicit DirectionBatch(std::size_t n) : x(n), y(n), z(n) {}
  void push(const Vec3f& w) {
    x.push_back(w.x);
    y.push_back(w.y);
    z.push_back(w.z);
  }
  std::size_t size() const { return x.size(); }
  Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  DirectionSpan span() const { return {x.data(), y.data(), z.data(), x.size()}; }
  DirectionSpan part(std::size_t first, std::size_t count) const {
    return {x.data() + first, y.data() + first, z.data() + first, count};
  }
  MutableDirectionSpan writable() { return {x.data(), y.data(), z.data(), x.size()}; }
};

inline Vec3f direction_at(double cos_theta, double phi) {
  const double s = std::sqrt(1 - cos_theta * cos_theta);
  return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(cos_theta)};
}

/// Uniform in solid angle over the hemisphere.
inline DirectionBatch random_directions(std::size_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  DirectionBatch b;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - uniform(random);
    b.push(direction_at(z, 2 * 3.14159265358979 * uniform(random)));
  }
  return b;
}

/// Points of [0, 1)^3.
inline DirectionBatch random_numbers(std::size_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  DirectionBatch b;
  const auto next = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  for (std::size_t i = 0; i < n; ++i) {
    const float u = next(), v = next();
    b.push({u, v, next()});
  }
  return b;
}

}  // namespace brdf::test
