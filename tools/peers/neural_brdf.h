// SPDX-License-Identifier: Apache-2.0
// The published networks of 675 weights per material (Sztrajman et al. 2021, "Neural BRDF representation and importance
// sampling"): two hidden layers of 21 rectified units from (h, d) to the logarithm of 1 + f.
#pragma once

#include <brdf/direction.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace brdf::peers {

/// How the measurement that a network was fitted to covers phi_d.
enum class Azimuth : std::uint8_t {
  full_circle,  ///< the RGL database; the difference vector is that of wo, as those networks fit their data best
  half_circle,  ///< MERL, phi_d modulo pi
};

class NeuralBrdf {
 public:
  static constexpr std::size_t inputs = 6, hidden = 21, channels = 3;
  static constexpr std::size_t weight_count =
      inputs * hidden + hidden + hidden * hidden + hidden + hidden * channels + channels;
  static constexpr std::size_t bytes = 4 * weight_count;

  /// Weights as published: for each layer a matrix of rows of its inputs, then the biases. Throws
  /// Error(invalid_argument) unless there are `weight_count` finite ones.
  NeuralBrdf(std::span<const float> weights, Azimuth azimuth);

  /// f(wi, wo) in 1/sr, three planes; 0 below the horizon. On the best instruction set of the machine.
  void eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept;
  /// One pair in plain C++.
  void eval(const Vec3f& wi, const Vec3f& wo, std::span<float, 3> f) const noexcept;

 private:
  std::array<float, weight_count> weights_;
  Azimuth azimuth_;
};

}  // namespace brdf::peers
