// SPDX-License-Identifier: Apache-2.0
#include "container/lobe_codes.h"

#include "container/lobe_quantiser.h"
#include "residual/range_coder.h"

#include <array>
#include <bit>
#include <cstdlib>

namespace brdf::container {
namespace {

using residual::AdaptiveBit;

AdaptiveBit percent(int p1) { return AdaptiveBit(static_cast<std::uint32_t>(65536 * p1 / 100)); }

enum Role : std::size_t { f90, first_channel, next_channel, roles };

/// Adaptive probabilities of one set of lobes.
class LobeModel {
 public:
  LobeModel() {
    // starting points measured over materials of several databases
    constexpr std::array<int, roles> nonzero = {70, 95, 94};
    constexpr std::array<std::array<int, lobe_code_bits>, roles> wider = {{{95, 97, 97, 96, 95, 93, 85, 60, 70, 60, 40},
                                                                           {99, 98, 97, 96, 95, 93, 90, 80, 57, 25, 10},
                                                                           {97, 98, 97, 92, 90, 85, 68, 55, 45, 20, 20}}};
    for (std::size_t r = 0; r < roles; ++r) {
      nonzero_[r] = percent(nonzero[r]);
      for (std::size_t w = 0; w < lobe_code_bits; ++w) wider_[r][w] = percent(wider[r][w]);
    }
  }

  /// Codes one kind with either coder and returns it.
  template <class Coder>
  LobeKind kind(Coder& coder, bool first_lobe, LobeKind value) {
    if (!coder.bit(microfacets_[first_lobe ? 0 : 1], value != LobeKind::lambert)) return LobeKind::lambert;
    return coder.bit(retro_, value == LobeKind::retro_ggx) ? LobeKind::retro_ggx : LobeKind::ggx;
  }

  /// Codes one amplitude: whether it is 0, else its distance from what is expected. Throws Error(malformed).
  template <class Coder>
  std::int32_t amplitude(Coder& coder, Role role, std::int32_t expected, std::int32_t value) {
    if (!coder.bit(nonzero_[role], value != 0)) return 0;
    const std::int32_t distance = step(coder, role, value - expected), read = expected + distance;
    if (read < 1 || read > largest_lobe_code)
      throw Error(ErrorCode::malformed, "lobes: an amplitude code is " + std::to_string(read) + ", not 1 to " + std::to_string(largest_lobe_code));
    return read;
  }

 private:
  template <class Coder>
  std::int32_t step(Coder& coder, Role role, std::int32_t value) {
    const auto magnitude = static_cast<std::uint32_t>(std::abs(value));
    const int wanted = static_cast<int>(std::bit_width(magnitude));
    int width = 0;
    while (width < lobe_code_bits && coder.bit(wider_[role][static_cast<std::size_t>(width)], width < wanted)) ++width;
    if (width == 0) return 0;
    // f90 is measured downwards from the largest code
    const bool negative = role == f90 || coder.raw(1, value < 0 ? 1U : 0U) != 0;
    const std::uint32_t leading = 1U << (width - 1);
    const auto read = static_cast<std::int32_t>(leading | coder.raw(width - 1, magnitude & (leading - 1)));
    return negative ? -read : read;
  }

  AdaptiveBit microfacets_[2] = {percent(40), percent(95)}, retro_ = percent(8);
  AdaptiveBit nonzero_[roles];
  AdaptiveBit wider_[roles][lobe_code_bits];
};

constexpr std::int32_t usual_channel = 1500;

/// Writes `set` or fills it, with either coder.
template <class Coder>
void code_lobes(Coder& coder, int exponent, LobeSet& set) {
  LobeModel model;
  for (std::size_t i = 0; i < set.lobes.size(); ++i) {
    Lobe& lobe = set.lobes[i];
    lobe.kind = model.kind(coder, i == 0, lobe.kind);
    if (has_microfacets(lobe.kind)) {
      lobe.alpha = alpha_of(static_cast<std::int32_t>(coder.raw(lobe_code_bits, static_cast<std::uint32_t>(alpha_code(lobe.alpha)))));
      lobe.f90 = amplitude_of(model.amplitude(coder, f90, largest_lobe_code, amplitude_code(lobe.f90, exponent)), exponent);
    }
    std::int32_t expected = usual_channel;
    for (std::size_t c = 0; c < lobe.color.size(); ++c) {
      const std::int32_t code = model.amplitude(coder, c == 0 ? first_channel : next_channel, expected, amplitude_code(lobe.color[c], exponent));
      lobe.color[c] = amplitude_of(code, exponent);
      if (code != 0) expected = code;
    }
  }
}

int exponent_above(const LobeSet& set) noexcept {
  double largest = 0;
  for (const Lobe& lobe : set.lobes) {
    if (has_microfacets(lobe.kind)) largest = std::max(largest, lobe.f90);
    for (const double c : lobe.color) largest = std::max(largest, c);
  }
  return largest > 0 ? std::clamp(static_cast<int>(std::ceil(std::log2(largest))), -exponent_offset, largest_exponent) : 0;
}

}  // namespace

std::vector<std::byte> write_lobes(const LobeSet& set) {
  residual::RangeEncoder coder;
  const int exponent = exponent_above(set);
  coder.raw(lobe_count_bits, static_cast<std::uint32_t>(set.lobes.size()));
  coder.raw(exponent_bits, static_cast<std::uint32_t>(exponent + exponent_offset));
  LobeSet copy = set;
  code_lobes(coder, exponent, copy);
  return coder.finish();
}

LobeSet read_lobes(std::span<const std::byte> bytes, int channels, std::uint32_t max_lobes) {
  residual::RangeDecoder coder(bytes);
  const std::uint32_t count = coder.raw(lobe_count_bits);
  check_lobe_count(count, max_lobes);
  const int exponent = exponent_of(coder.raw(exponent_bits));
  Lobe empty;
  empty.color.assign(static_cast<std::size_t>(channels), 0.0);
  LobeSet set{channels, std::vector<Lobe>(count, empty)};
  code_lobes(coder, exponent, set);
  if (coder.overrun() > 4) throw Error(ErrorCode::malformed, "lobes: they go on beyond the end of their chunk");
  if (coder.unread() > 0) throw Error(ErrorCode::malformed, "lobes: bytes are left over in their chunk");
  return set;
}

LobeSet quantise_lobes(const LobeSet& lobes) { return read_lobes(write_lobes(lobes), lobes.channels, (1U << lobe_count_bits) - 1); }

}  // namespace brdf::container
