// SPDX-License-Identifier: Apache-2.0
#include "eval/lobe_params.h"

#include <brdf/error.h>
#include <brdf/limits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace brdf::eval {

namespace {

[[noreturn]] void refuse(std::size_t lobe, const std::string& field, const std::string& found, const std::string& allowed) {
  throw Error(ErrorCode::invalid_argument,
              "Lobe " + std::to_string(lobe) + ": " + field + " is " + found + ", allowed is " + allowed + ".");
}

void check_range(std::size_t lobe, const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN
  refuse(lobe, field, std::to_string(value), std::to_string(low) + " to " + std::to_string(high));
}

void check_lobe(std::size_t i, const Lobe& lobe, int channels) {
  if (lobe.kind != LobeKind::lambert && lobe.kind != LobeKind::ggx && lobe.kind != LobeKind::retro_ggx)
    refuse(i, "kind", std::to_string(static_cast<int>(lobe.kind)), "0, 1 or 2");
  if (lobe.color.size() != static_cast<std::size_t>(channels))
    refuse(i, "the number of colour values", std::to_string(lobe.color.size()), std::to_string(channels));
  for (double c : lobe.color) check_range(i, "a colour value", c, 0, max_reflectance);
  if (lobe.kind == LobeKind::lambert) return;
  // a small slack so that 1e-5 survives a round trip through float
  if (!(lobe.alpha >= min_alpha * (1 - 1e-6) && lobe.alpha <= 1))
    refuse(i, "alpha", std::to_string(lobe.alpha), "1e-5 to 1");
  check_range(i, "f90", lobe.f90, 0, max_reflectance);
}

std::vector<FourLobes> in_fours(const std::vector<GgxLobe>& ggx) {
  std::vector<FourLobes> fours((ggx.size() + 3) / 4);
  for (std::size_t k = 0; k < 4 * fours.size(); ++k) {
    GgxLobe g;
    if (k < ggx.size())
      g = ggx[k];
    else
      g.f90 = 0;
    FourLobes& four = fours[k / 4];
    const std::size_t lane = k % 4;
    four.alpha[lane] = g.alpha;
    four.inv_alpha[lane] = g.inv_alpha;
    four.alpha2[lane] = g.alpha2;
    four.one_minus_alpha2[lane] = g.one_minus_alpha2;
    four.f90[lane] = g.f90;
    four.least_shadowing[lane] = g.least_shadowing;
    four.retro[lane] = g.retro ? 1.0f : 0.0f;
  }
  return fours;
}

}  // namespace

LobeParams::LobeParams(const LobeSet& set) : channels(set.channels) {
  const int most = static_cast<int>(DecodeLimits{}.max_channels);
  if (channels < 1 || channels > most)
    throw Error(ErrorCode::invalid_argument, "Lobes: the number of channels is " + std::to_string(channels) +
                                                 ", allowed is 1 to " + std::to_string(most) + ".");
  std::size_t count = 0;
  for (std::size_t i = 0; i < set.lobes.size(); ++i) {
    check_lobe(i, set.lobes[i], channels);
    if (set.lobes[i].kind != LobeKind::lambert) ++count;
  }
  if (count > max_ggx_lobes)
    throw Error(ErrorCode::limit_exceeded, "Lobes: the number of GGX lobes is " + std::to_string(count) +
                                               ", allowed is at most " + std::to_string(max_ggx_lobes) + ".");
  const auto n = static_cast<std::size_t>(channels);
  padded_channels = (n + 7) / 8 * 8;
  std::vector<double> diffuse(n, 0.0);
  f0.assign((count + 3) / 4 * 4 * padded_channels, 0.0f);
  const auto add_ggx = [this, n](const Lobe& lobe) {
    const double a = lobe.alpha;
    GgxLobe g;
    g.alpha = static_cast<float>(a) * ndf_scale;
    g.inv_alpha = static_cast<float>(1 / a) * ndf_scale;
    g.alpha2 = static_cast<float>(a * a);
    g.one_minus_alpha2 = static_cast<float>(1 - a * a);
    // D is at most 1 / (pi alpha^2); a larger denominator than with this floor would leave the range of float
    const double largest_floor = 100, per_shadowing = 0.5 * std::numbers::inv_pi / (a * a * max_lobe_value);
    const double largest = std::min(std::max(lobe.f90, *std::max_element(lobe.color.begin(), lobe.color.end())), largest_floor / per_shadowing);
    g.least_shadowing = static_cast<float>(std::max(largest, 1.0) * per_shadowing);
    g.f90 = static_cast<float>(std::min(lobe.f90, largest));
    g.retro = lobe.kind == LobeKind::retro_ggx;
    float* colours = f0.data() + ggx.size() * padded_channels;
    for (std::size_t c = 0; c < n; ++c) colours[c] = static_cast<float>(std::min(lobe.color[c], largest));
    g.f0 = colours;
    ggx.push_back(g);
  };
  for (const Lobe& lobe : set.lobes) {
    if (lobe.kind == LobeKind::ggx) add_ggx(lobe);
    if (lobe.kind == LobeKind::lambert)
      for (std::size_t c = 0; c < n; ++c) diffuse[c] += lobe.color[c] * std::numbers::inv_pi;
  }
  forward_count = ggx.size();
  for (const Lobe& lobe : set.lobes)
    if (lobe.kind == LobeKind::retro_ggx) add_ggx(lobe);
  for (double c : diffuse) lambert.push_back(static_cast<float>(c));
  lambert.resize(padded_channels, 0.0f);
  fours = in_fours(ggx);
}

}  // namespace brdf::eval
