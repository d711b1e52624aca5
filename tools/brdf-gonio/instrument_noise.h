// SPDX-License-Identifier: Apache-2.0
// What a gonioreflectometer does to a surface: noise, and cells that it never saw.
#pragma once

#include <array>
#include <cstdint>

namespace brdf::gonio {

/// Every answer depends on seed, pair number and cosine alone: the order of pairs does not matter, and no generator or
/// distribution of a standard library is involved.
class InstrumentNoise {
 public:
  /// `sigma`: relative standard deviation at normal incidence.
  InstrumentNoise(std::uint64_t seed, double sigma) noexcept : seed_(seed), sigma_(sigma) {}

  /// Whether the pair is measured: not close to grazing, with a ragged limit, and with losses near it.
  bool measures(std::uint64_t pair, double smaller_cosine) const noexcept;

  /// Multiplies by log-normal noise of mean 1, part of it common to the channels.
  void disturb(std::uint64_t pair, double smaller_cosine, std::array<double, 3>& f) const noexcept;

 private:
  std::uint64_t seed_;
  double sigma_;
};

}  // namespace brdf::gonio
