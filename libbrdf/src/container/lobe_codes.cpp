// SPDX-License-Identifier: Apache-2.0
#include "container/lobe_codes.h"

#include <algorithm>
#include <cmath>

namespace brdf::container {
namespace {

constexpr int amplitude_bits = 11, alpha_bits = 11;
constexpr std::uint32_t largest_code = 2047;
constexpr int largest_exponent = 99;  // 6e29: products of lobes and ratios stay finite floats
constexpr double alpha_octaves = 16.6096404744368;  // log2(1 / 1e-5)

double amplitude_of(std::uint32_t code, int exponent) noexcept {
  return code == 0 ? 0.0 : std::exp2(exponent - (largest_code - code) / 128.0);
}

std::uint32_t amplitude_code(double value, int exponent) noexcept {
  if (!(value > 0)) return 0;
  const double code = std::round(largest_code + (std::log2(value) - exponent) * 128.0);
  return code < 1 ? 0U : static_cast<std::uint32_t>(std::min(code, static_cast<double>(largest_code)));
}

bool has_microfacets(LobeKind kind) noexcept { return kind != LobeKind::lambert; }

}  // namespace

void write_lobes(BitWriter& out, const LobeSet& set) {
  double largest = 0;
  for (const Lobe& lobe : set.lobes) {
    if (has_microfacets(lobe.kind)) largest = std::max(largest, lobe.f90);
    for (const double c : lobe.color) largest = std::max(largest, c);
  }
  const int exponent = largest > 0 ? std::clamp(static_cast<int>(std::ceil(std::log2(largest))), -128, largest_exponent) : 0;
  out.put(static_cast<std::uint32_t>(set.lobes.size()), 4);
  out.put(static_cast<std::uint32_t>(exponent + 128), 8);
  for (const Lobe& lobe : set.lobes) {
    out.put(static_cast<std::uint32_t>(lobe.kind), 3);
    if (has_microfacets(lobe.kind)) {
      const double octaves = std::clamp(-std::log2(lobe.alpha), 0.0, alpha_octaves);
      out.put(static_cast<std::uint32_t>(std::lround(octaves / alpha_octaves * largest_code)), alpha_bits);
      out.put(amplitude_code(lobe.f90, exponent), amplitude_bits);
    }
    for (const double c : lobe.color) out.put(amplitude_code(c, exponent), amplitude_bits);
  }
}

LobeSet read_lobes(BitReader& in, int channels, std::uint32_t max_lobes) {
  LobeSet set;
  set.channels = channels;
  const std::uint32_t count = in.get(4);
  if (count > max_lobes)
    throw Error(ErrorCode::limit_exceeded,
                "lobes: " + std::to_string(count) + " are stored, the limit is " + std::to_string(max_lobes));
  const int exponent = static_cast<int>(in.get(8)) - 128;
  if (exponent > largest_exponent)
    throw Error(ErrorCode::malformed, "lobes: amplitudes up to 2^" + std::to_string(exponent) + " are declared, at most 2^" +
                                          std::to_string(largest_exponent) + " are allowed");
  for (std::uint32_t i = 0; i < count; ++i) {
    Lobe lobe;
    const std::uint32_t kind = in.get(3);
    if (kind > static_cast<std::uint32_t>(LobeKind::retro_ggx))
      throw Error(ErrorCode::unsupported, "lobes: kind " + std::to_string(kind) + " is not known to this version");
    lobe.kind = static_cast<LobeKind>(kind);
    if (has_microfacets(lobe.kind)) {
      lobe.alpha = std::exp2(-static_cast<double>(in.get(alpha_bits)) / largest_code * alpha_octaves);
      lobe.f90 = amplitude_of(in.get(amplitude_bits), exponent);
    }
    lobe.color.resize(static_cast<std::size_t>(channels));
    for (double& c : lobe.color) c = amplitude_of(in.get(amplitude_bits), exponent);
    set.lobes.push_back(std::move(lobe));
  }
  return set;
}

LobeSet quantise_lobes(const LobeSet& lobes) {
  BitWriter out;
  write_lobes(out, lobes);
  BitReader in(out.bytes(), "lobes");
  return read_lobes(in, lobes.channels, 15);
}

}  // namespace brdf::container
