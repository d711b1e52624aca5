// SPDX-License-Identifier: Apache-2.0
#include "neural_brdf.h"

#include <brdf/error.h>

#include "neural_batch.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brdf::peers {
namespace {

/// y = bias + x times the matrix at `weights`; returns what follows the biases.
template <std::size_t n, std::size_t m>
const float* layer(const float* weights, const std::array<float, n>& x, std::array<float, m>& y) noexcept {
  const float* bias = weights + n * m;
  std::copy_n(bias, m, y.begin());
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < m; ++j) y[j] += x[k] * weights[k * m + j];
  return bias + m;
}

/// h = (sin theta_h, 0, cos theta_h) and the difference vector.
std::array<float, NeuralBrdf::inputs> network_inputs(const Vec3f& wi, const Vec3f& wo, Azimuth azimuth) noexcept {
  const Vec3f s = wi + wo, d = wi - wo;
  const float rho = std::sqrt(s.x * s.x + s.y * s.y), length = std::sqrt(rho * rho + s.z * s.z);
  const bool off_pole = rho > 1e-12F * length;
  const float c = off_pole ? s.x / rho : 1, e = off_pole ? s.y / rho : 0;
  float x = ((c * d.x + e * d.y) * s.z - rho * d.z) / length / 2, y = (c * d.y - e * d.x) / 2;
  if (azimuth == Azimuth::full_circle || y < 0 || (y == 0 && x < 0)) {
    x = -x;
    y = -y;
  }
  return {rho / length, 0, s.z / length, x, y, length / 2};
}

}  // namespace

NeuralBrdf::NeuralBrdf(std::span<const float> weights, Azimuth azimuth) : weights_{}, azimuth_(azimuth) {
  if (weights.size() != weight_count) {
    throw Error(ErrorCode::invalid_argument, "neural network: has " + std::to_string(weights.size()) + " weights, " +
                                                 std::to_string(weight_count) + " are needed");
  }
  if (!std::ranges::all_of(weights, [](float w) { return std::isfinite(w); }))
    throw Error(ErrorCode::invalid_argument, "neural network: has a weight that is not finite");
  std::ranges::copy(weights, weights_.begin());
}

void NeuralBrdf::eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept {
  network_batch(weights_.data(), azimuth_, wi, wo, f);
}

void NeuralBrdf::eval(const Vec3f& wi, const Vec3f& wo, std::span<float, 3> f) const noexcept {
  std::ranges::fill(f, 0.0F);
  if (!(wi.z > 0) || !(wo.z > 0)) return;
  std::array<float, hidden> first, second;
  std::array<float, channels> out;
  const auto rectify = [](std::array<float, hidden>& x) {
    for (float& v : x) v = std::max(v, 0.0F);
  };
  const float* next = layer(weights_.data(), network_inputs(wi, wo, azimuth_), first);
  rectify(first);
  next = layer(next, first, second);
  rectify(second);
  layer(next, second, out);
  for (std::size_t c = 0; c < channels; ++c) f[c] = std::expm1(std::clamp(out[c], 0.0F, 50.0F));
}

}  // namespace brdf::peers
