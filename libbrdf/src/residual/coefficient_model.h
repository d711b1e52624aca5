// SPDX-License-Identifier: Apache-2.0
// The statistical model of coefficients: contexts from neighbours that both sides already know.
#pragma once

#include "residual/coefficient_order.h"
#include "residual/range_coder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace brdf::residual {

/// Magnitudes known so far, per channel, with a border of zeros.
class MagnitudeField {
 public:
  MagnitudeField(int channels, int k, int l, int m)
      : k_(k + 2), l_(l + 2), m_(m + 2), data_(static_cast<std::size_t>(channels) * size(), 0) {}
  void clear() { std::fill(data_.begin(), data_.end(), std::uint8_t{0}); }
  std::size_t index(int channel, Frequency f) const noexcept {
    return ((static_cast<std::size_t>(channel) * static_cast<std::size_t>(m_) + f.m + 2U) * static_cast<std::size_t>(l_) +
            f.l + 2U) * static_cast<std::size_t>(k_) + f.k + 2U;
  }
  void set(int channel, Frequency f, std::int32_t q) noexcept {
    data_[index(channel, f)] = static_cast<std::uint8_t>(std::min(std::abs(q), 255));
  }
  /// Weighted sum of known neighbours: lower frequencies of this channel, the same frequency of earlier ones.
  std::uint32_t activity(int channel, Frequency f, bool even_m_only) const noexcept {
    const std::uint8_t* p = data_.data() + index(channel, f);
    const auto row = static_cast<std::ptrdiff_t>(k_), plane = static_cast<std::ptrdiff_t>(k_) * l_;
    const auto at = [p](std::ptrdiff_t back) { return static_cast<std::uint32_t>(p[-back]); };
    std::uint32_t v = 2 * at(1) + at(2) + 2 * at(row) + at(2 * row) + at(row + 1) + at(2 * plane);
    v += even_m_only ? at(2 * plane) : at(plane);
    const auto channel_size = static_cast<std::ptrdiff_t>(size());
    if (channel > 0) v += 2 * static_cast<std::uint32_t>(p[-channel_size * channel]);
    if (channel > 1) v += static_cast<std::uint32_t>(p[-channel_size]);
    return v;
  }

 private:
  std::size_t size() const noexcept {
    return static_cast<std::size_t>(k_) * static_cast<std::size_t>(l_) * static_cast<std::size_t>(m_);
  }
  int k_, l_, m_;
  std::vector<std::uint8_t> data_;
};

inline constexpr int activity_classes = 8, radius_classes = 6;

inline int activity_class(std::uint32_t v) noexcept {
  return v < 4 ? static_cast<int>(v) : v < 6 ? 4 : v < 9 ? 5 : v < 14 ? 6 : 7;
}

/// Class of a place in the order: low frequencies are larger than their neighbours say.
inline int radius_class(std::uint32_t j) noexcept { return std::min(static_cast<int>(std::bit_width(j / 6U)), radius_classes - 1); }

/// Adaptive probabilities; one object lives through all layers of a file.
class CoefficientModel {
 public:
  CoefficientModel() {
    // starting points measured over materials of several databases; adaptation corrects them within a few symbols
    static constexpr std::array<int, activity_classes> nonzero = {5, 20, 30, 40, 50, 60, 70, 85};
    for (int luma = 0; luma < 2; ++luma)
      for (int a = 0; a < activity_classes; ++a)
        for (int r = 0; r < radius_classes; ++r)
          zero_[luma][a][r] = AdaptiveBit(static_cast<std::uint32_t>(65536 * nonzero[static_cast<std::size_t>(a)] * (10 - r) / 1000));
    for (int a = 0; a < 4; ++a)
      for (int n = 0; n < 5; ++n) more_[a][n] = AdaptiveBit(static_cast<std::uint32_t>(65536 * (30 + 10 * a) / 100));
  }

  /// Codes one value with any coder (encoder, decoder, rate meter) and returns it.
  template <class Coder>
  std::int32_t code(Coder& coder, bool first_channel, int activity, int radius, std::int32_t value) {
    AdaptiveBit& zero = zero_[first_channel ? 0 : 1][activity][activity < 4 ? radius : 0];
    if (!coder.bit(zero, value != 0)) return 0;
    const bool negative = coder.raw(1, value < 0 ? 1U : 0U) != 0;
    const std::int32_t magnitude = value < 0 ? -value : value;
    std::int32_t n = 1;
    while (n < escape && coder.bit(more_[activity / 2][std::min(n, 5) - 1], magnitude > n)) ++n;
    if (n == escape) n += escape_code(coder, magnitude - escape);
    return negative ? -n : n;
  }

  static constexpr std::int32_t escape = 15;

  /// Bits that `code` would spend now, for rate estimates; magnitude 0 to escape.
  double cost(bool first_channel, int activity, int radius, std::int32_t magnitude) const {
    const auto bits = [](const AdaptiveBit& b, bool one) {
      return -std::log2((one ? b.p1() : 65536U - b.p1()) / 65536.0);
    };
    const AdaptiveBit& zero = zero_[first_channel ? 0 : 1][activity][activity < 4 ? radius : 0];
    if (magnitude == 0) return bits(zero, false);
    double sum = bits(zero, true) + 1;  // and the sign
    for (std::int32_t n = 1; n < std::min(magnitude, escape); ++n) sum += bits(more_[activity / 2][std::min(n, 5) - 1], true);
    if (magnitude < escape) sum += bits(more_[activity / 2][std::min(magnitude, 5) - 1], false);
    return sum;
  }

 private:
  /// Exponential Golomb code of order 0 for what lies beyond the escape.
  template <class Coder>
  static std::int32_t escape_code(Coder& coder, std::int32_t rest) {
    const auto target = static_cast<std::uint32_t>(rest) + 1U;
    int bits = 0;
    const int wanted = static_cast<int>(std::bit_width(target)) - 1;
    while (bits < 21 && coder.raw(1, bits < wanted ? 1U : 0U) != 0) ++bits;
    std::uint32_t v = 1;
    if (bits > 0) v = (1U << bits) | coder.raw(bits, target & ((1U << bits) - 1U));
    return static_cast<std::int32_t>(v - 1U);
  }

  AdaptiveBit zero_[2][activity_classes][radius_classes];
  AdaptiveBit more_[4][5];
};

}  // namespace brdf::residual
