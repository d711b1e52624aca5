// SPDX-License-Identifier: Apache-2.0
#include "instrument_noise.h"

#include <cmath>
#include <numbers>

namespace brdf::gonio {
namespace {

constexpr double reach = 82 * std::numbers::pi / 180;        // largest angle that is measured
constexpr double raggedness = 1.5 * std::numbers::pi / 180;  // the limit of a pair lies up to this much below
constexpr double lossy_from = 77 * std::numbers::pi / 180, loss = 0.12;
constexpr double common_share = 0.64;  // of the variance; the lamp flickers for all channels

// streams of random numbers, so that no decision shares bits with another
enum Stream : std::uint64_t { limit_stream, loss_stream, lamp_stream, channel_stream };

std::uint64_t mix(std::uint64_t x) noexcept {  // finaliser of splitmix64 (Steele et al. 2014)
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Uniform in (0, 1), a function of its arguments.
double uniform(std::uint64_t seed, std::uint64_t pair, std::uint64_t stream) noexcept {
  const std::uint64_t bits = mix(mix(mix(seed) ^ pair) ^ stream);
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

/// Standard normal by Box and Muller (1958).
double normal(std::uint64_t seed, std::uint64_t pair, std::uint64_t stream) noexcept {
  const double u = uniform(seed, pair, 2 * stream + 64), v = uniform(seed, pair, 2 * stream + 65);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace

bool InstrumentNoise::measures(std::uint64_t pair, double smaller_cosine) const noexcept {
  if (!(smaller_cosine > std::cos(reach - raggedness * uniform(seed_, pair, limit_stream)))) return false;
  return smaller_cosine > std::cos(lossy_from) || uniform(seed_, pair, loss_stream) > loss;
}

void InstrumentNoise::disturb(std::uint64_t pair, double smaller_cosine, std::array<double, 3>& f) const noexcept {
  if (sigma_ == 0) return;
  // The signal falls with the cosine, and the relative noise of counted photons with the root of the signal.
  const double sigma = sigma_ / std::sqrt(smaller_cosine);
  const double lamp = std::sqrt(common_share) * normal(seed_, pair, lamp_stream);
  for (std::size_t c = 0; c < f.size(); ++c) {
    const double z = lamp + std::sqrt(1 - common_share) * normal(seed_, pair, channel_stream + c);
    f[c] *= std::exp(sigma * z - 0.5 * sigma * sigma);
  }
}

}  // namespace brdf::gonio
