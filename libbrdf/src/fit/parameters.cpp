// SPDX-License-Identifier: Apache-2.0
#include "fit/parameters.h"

#include "lobes/ggx.h"

#include <algorithm>
#include <cmath>

namespace brdf::fit {
namespace {

// Relative to the mean f, far beyond anything that the loss can tell from 0, and beyond any reflectance.
constexpr double min_color = 1e-9, max_color = 1e9;

double bounded_log(double v) noexcept { return std::log(std::clamp(v, min_color, max_color)); }

}  // namespace

Layout::Layout(std::vector<LobeKind> kinds, int channels) : kinds_(std::move(kinds)), channels_(channels) {
  for (const LobeKind kind : kinds_) {
    first_.push_back(size_);
    size_ += channels + (kind == LobeKind::lambert ? 0 : 2);
  }
}

Layout layout_of(const LobeSet& set) {
  std::vector<LobeKind> kinds;
  for (const Lobe& lobe : set.lobes) kinds.push_back(lobe.kind);
  return {std::move(kinds), set.channels};
}

std::vector<double> to_parameters(const LobeSet& set) {
  std::vector<double> p;
  for (const Lobe& lobe : set.lobes) {
    if (lobe.kind != LobeKind::lambert) {
      p.push_back(std::log(std::clamp(lobe.alpha, lobes::min_alpha, lobes::max_alpha)));
      p.push_back(bounded_log(lobe.f90));
    }
    for (const double c : lobe.color) p.push_back(bounded_log(c));
  }
  return p;
}

LobeSet from_parameters(const Layout& layout, const std::vector<double>& p) {
  LobeSet set;
  set.channels = layout.channels();
  for (std::size_t l = 0; l < layout.kinds().size(); ++l) {
    Lobe lobe;
    lobe.kind = layout.kinds()[l];
    if (lobe.kind != LobeKind::lambert) {
      const auto at = static_cast<std::size_t>(layout.shape(l));
      lobe.alpha = std::clamp(std::exp(p[at]), lobes::min_alpha, lobes::max_alpha);
      lobe.f90 = std::exp(p[at + 1]);
    }
    for (int c = 0; c < layout.channels(); ++c) {
      lobe.color.push_back(std::exp(p[static_cast<std::size_t>(layout.color(l) + c)]));
    }
    set.lobes.push_back(std::move(lobe));
  }
  return set;
}

std::pair<std::vector<double>, std::vector<double>> parameter_bounds(const Layout& layout) {
  const auto n = static_cast<std::size_t>(layout.size());
  std::vector<double> lower(n, std::log(min_color)), upper(n, std::log(max_color));
  for (std::size_t l = 0; l < layout.kinds().size(); ++l) {
    if (layout.kinds()[l] == LobeKind::lambert) continue;
    lower[static_cast<std::size_t>(layout.shape(l))] = std::log(lobes::min_alpha);
    upper[static_cast<std::size_t>(layout.shape(l))] = std::log(lobes::max_alpha);
  }
  return {std::move(lower), std::move(upper)};
}

}  // namespace brdf::fit
