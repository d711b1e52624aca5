// SPDX-License-Identifier: Apache-2.0
#include "query/descriptor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::service {
namespace {

struct Pair {
  Vec3f wi, wo;
};

/// Rusinkiewicz's construction with phi_h = 0 and phi_d = 90 degrees: d lies in the plane of h and y.
Pair pair_at(double theta_h, double theta_d) noexcept {
  const double sh = std::sin(theta_h), ch = std::cos(theta_h), sd = std::sin(theta_d), cd = std::cos(theta_d);
  return {Vec3f(Vec3d(sh * cd, sd, ch * cd)), Vec3f(Vec3d(sh * cd, -sd, ch * cd))};
}

/// Ends of the bands of theta_h that the angles stand for, degrees.
constexpr std::array<double, descriptor_theta_h.size() + 1> band_ends{0, 1, 3.5, 7.5, 15, 27.5, 45, 90};

/// Root of the share of all half vectors that a band has, as of the pixels of a sphere under a distant light; their mean
/// square is 1. Without it the few degrees of a highlight outweigh the colour of everything else.
double weight(std::size_t band, double degree) noexcept {
  const double share = std::cos(band_ends[band] * degree) - std::cos(band_ends[band + 1] * degree);
  return std::sqrt(share * static_cast<double>(descriptor_theta_h.size()));
}

}  // namespace

std::array<double, 3> descriptor_color(const Channels& channels, std::span<const float> f) {
  const auto at = [&f](std::size_t c) { return static_cast<double>(f[c]); };
  if (channels.model == ChannelModel::rgb && f.size() == 3) return {at(0), at(1), at(2)};
  if (channels.model == ChannelModel::xyz && f.size() == 3) {  // IEC 61966-2-1
    return {3.2406 * at(0) - 1.5372 * at(1) - 0.4986 * at(2), -0.9689 * at(0) + 1.8758 * at(1) + 0.0415 * at(2),
            0.0557 * at(0) - 0.2040 * at(1) + 1.0570 * at(2)};
  }
  double all = 0;
  std::array<double, 3> sum{}, count{};
  for (std::size_t c = 0; c < f.size(); ++c) {
    all += at(c);
    if (c >= channels.wavelengths_nm.size()) continue;
    const float nm = channels.wavelengths_nm[c];
    const std::size_t band = nm < 500 ? 2 : nm < 600 ? 1 : 0;
    sum[band] += at(c);
    count[band] += 1;
  }
  const double mean = f.empty() ? 0 : all / static_cast<double>(f.size());
  std::array<double, 3> rgb{mean, mean, mean};
  for (std::size_t b = 0; b < rgb.size(); ++b)
    if (count[b] > 0) rgb[b] = sum[b] / count[b];
  return rgb;
}

Descriptor describe(const Material& material) {
  constexpr double degree = std::numbers::pi / 180;
  Descriptor d{};
  std::vector<float> f(static_cast<std::size_t>(material.channels()));
  std::size_t next = 0;
  for (const double theta_d : descriptor_theta_d) {
    for (std::size_t band = 0; band < descriptor_theta_h.size(); ++band) {
      const Pair p = pair_at(descriptor_theta_h[band] * degree, theta_d * degree);
      material.eval(p.wi, p.wo, f);
      for (const double value : descriptor_color(material.info().channels, f)) {
        const double x = std::max(value * static_cast<double>(p.wi.z), 0.0);
        d[next++] = static_cast<float>(weight(band, degree) * std::cbrt(x / (1 + x / 8)));
      }
    }
  }
  return d;
}

}  // namespace brdf::service
