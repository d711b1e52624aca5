// SPDX-License-Identifier: Apache-2.0
#include "error_bands.h"

#include "geometry/half_difference.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace brdf::cli {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double beyond = 90.5;  // the end of a last band, which takes 90 degrees in

/// The angle of an axis for one pair.
double angle(const std::string& axis, const Vec3f& wi, const Vec3f& wo) {
  if (axis == "theta_max") return degrees * std::acos(std::clamp(static_cast<double>(std::min(wi.z, wo.z)), -1.0, 1.0));
  const auto g = geometry::half_difference(Vec3d(wi), Vec3d(wo));
  return degrees * (axis == "theta_h" ? std::atan2(g.sin_theta_h, g.cos_theta_h) : std::atan2(g.sin_theta_d, g.cos_theta_d));
}

void append(std::vector<ErrorBand>& bands, const char* axis, std::span<const double> ends) {
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) bands.push_back({axis, ends[i], ends[i + 1]});
}

}  // namespace

std::vector<ErrorBand> error_bands(int channels) {
  static constexpr double half[] = {0, 0.3, 1, 2, 5, 10, 20, 45, beyond}, difference[] = {0, 5, 15, 30, 45, 60, 75, beyond},
                          largest[] = {0, 60, 75, 80, 85, 88, beyond};
  std::vector<ErrorBand> bands{{"none", 0, 0}};
  append(bands, "theta_h", half);
  append(bands, "theta_d", difference);
  append(bands, "theta_max", largest);
  for (int c = 0; c < channels; ++c) bands.push_back({"channel", static_cast<double>(c), static_cast<double>(c)});
  return bands;
}

ErrorReport score_without(const Comparison& comparison, const ErrorBand& band, const BatchEval& reference, const BatchEval& candidate) {
  return comparison.score([&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    candidate(wi, wo, out);
    if (band.axis == "none") return;
    const std::size_t channels = out.size() / wi.size();
    if (band.axis == "channel") {
      std::vector<float> perfect(out.size());
      reference(wi, wo, perfect);
      for (std::size_t at = static_cast<std::size_t>(band.from); at < out.size(); at += channels) out[at] = perfect[at];
      return;
    }
    std::vector<std::size_t> rows;  // within the band: only there is the reference, which may be slow, asked
    std::vector<Vec3f> in, view;
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const double a = angle(band.axis, wi[i], wo[i]);
      if (!(a >= band.from && a < band.to)) continue;
      rows.push_back(i);
      in.push_back(wi[i]);
      view.push_back(wo[i]);
    }
    if (rows.empty()) return;
    std::vector<float> perfect(rows.size() * channels);
    reference(in, view, perfect);
    for (std::size_t k = 0; k < rows.size(); ++k) std::copy_n(perfect.data() + k * channels, channels, out.data() + rows[k] * channels);
  });
}

}  // namespace brdf::cli
