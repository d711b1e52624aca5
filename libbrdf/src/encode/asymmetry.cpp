// SPDX-License-Identifier: Apache-2.0
#include "encode/asymmetry.h"

#include "metrics/queries.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace brdf::encode {
namespace {

Vec3d mirrored(const Vec3d& w) noexcept { return {w.x, -w.y, w.z}; }

std::string with_number(const char* format, double value) {
  char text[200];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

Asymmetry measure_asymmetry(const Measurement& m, double quality) {
  metrics::QuerySet set;
  metrics::append_pairs(set, quality);
  const MeasurementInterpolator reference(m);
  const auto n = static_cast<std::size_t>(m.channels.count);
  std::vector<double> f(n), exchanged(n), other(n);
  Asymmetry sum;
  double weights = 0;
  for (std::size_t i = 0; i < set.pairs; ++i) {
    if (set.pair_band[i] > metrics::last_headline_band) continue;
    const Vec3d wi(set.wi[i]), wo(set.wo[i]);
    if (!reference.eval(wi, wo, f)) continue;
    const bool both = reference.eval(wo, wi, exchanged), sides = reference.eval(mirrored(wi), mirrored(wo), other);
    const auto distance = [&](const std::vector<double>& g) {
      double d = 0;
      for (std::size_t c = 0; c < n; ++c) {
        const double a = std::max(f[c], 0.0) * wi.z, b = std::max(g[c], 0.0) * wi.z;
        d += std::abs(std::log1p(a) - std::log1p((a + b) / 2));
      }
      return d / static_cast<double>(n);
    };
    weights += set.pair_weight[i];
    if (both) sum.reciprocity += set.pair_weight[i] * distance(exchanged);
    if (sides) sum.mirror += set.pair_weight[i] * distance(other);
  }
  if (weights > 0) {
    sum.reciprocity /= weights;
    sum.mirror /= weights;
  }
  return sum;
}

std::string reciprocity_sentence(SymmetryMode mode, bool none, bool reciprocal, bool lobes_alone, double asymmetry, double gain) {
  if (none) return "reciprocity: exact, as in the measurement";
  const std::string size = with_number("the measurement's asymmetry is log_mae %.3g", asymmetry);
  if (lobes_alone) return "reciprocity: exact, for lobes alone have no asymmetry; " + size;
  if (mode == SymmetryMode::enforce) return "reciprocity: enforced as asked, exactly; " + size + " and was averaged";
  if (mode == SymmetryMode::keep) return "reciprocity: not enforced, as asked; " + size;
  if (reciprocal)
    return "reciprocity: enforced, exactly, since the asymmetry was not worth its bytes" +
           (gain < 0 ? with_number(" (keeping it would cost %.2f dB)", -gain) : std::string()) + "; " + size;
  return "reciprocity: asymmetry kept" + (gain > 0 ? with_number(", which is worth %.2f dB at this size", gain) : std::string()) + "; " + size;
}

std::string mirror_sentence(SymmetryMode mode, bool kept, bool lobes_alone, double asymmetry, double gain) {
  if (asymmetry < negligible_asymmetry && !kept) return "mirror: exact, as in the measurement";
  const std::string size = with_number("the measurement's asymmetry is log_mae %.3g", asymmetry);
  if (kept) return "mirror: asymmetry kept" + (gain > 0 ? with_number(", which is worth %.2f dB at this size", gain) : std::string()) + "; " + size;
  if (lobes_alone) return "mirror: exact, for lobes alone have no asymmetry; " + size;
  if (mode == SymmetryMode::enforce) return "mirror: enforced as asked, exactly; " + size + " and was averaged";
  if (mode == SymmetryMode::keep) return "mirror: cannot be kept for data of this kind; " + size + " and was averaged";
  return "mirror: enforced, exactly, since the asymmetry was not worth its bytes" +
         (gain < 0 ? with_number(" (keeping it would cost %.2f dB)", -gain) : std::string()) + "; " + size;
}

}  // namespace brdf::encode
