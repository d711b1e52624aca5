// SPDX-License-Identifier: Apache-2.0
#include "fit/collect_samples.h"

#include "geometry/half_difference.h"

#include <algorithm>
#include <cmath>

namespace brdf::fit {
namespace {

constexpr double pi = 3.14159265358979323846;
const double min_cosine = std::cos(85.0 * pi / 180.0);

/// One in five samples is drawn in the coordinates of the retro lobe, whose peak the others would see too thinly.
constexpr int retro_period = 5;
constexpr double retro_share = 1.0 / retro_period;

/// Weight = (cosine-weighted measure / density) ^ tempering: 1 is the plain integral over both hemispheres, in which a
/// narrow peak counts for nothing; 0 the bare sample density, in which it counts for too much.
constexpr double tempering = 0.5;

/// Additive recurrence on the root of x^4 = x + 1 (Roberts 2018): any prefix of it is evenly spread.
class EvenSequence {
 public:
  explicit EvenSequence(double offset) noexcept : u_{offset, offset, offset} {}
  const double* next() noexcept {
    constexpr double step[3] = {0.81917251339616443, 0.67104360670378920, 0.54970047790197026};
    for (int k = 0; k < 3; ++k) {
      u_[k] += step[k];
      if (u_[k] >= 1) u_[k] -= 1;
    }
    return u_;
  }

 private:
  double u_[3];
};

Vec3d turned(const Vec3d& w) noexcept { return {-w.x, -w.y, w.z}; }

/// Density per dwi dwo of drawing theta_h = t^2 pi/2 and theta_d, phi_d evenly, up to a constant factor:
/// 1 / (4 cos theta_d sin theta_d sin theta_h d theta_h/dt), from dwi dwo = 4 cos theta_d dw_h dw_d.
double density(const Vec3d& wi, const Vec3d& wo) noexcept {
  const auto g = geometry::half_difference<double>(wi, wo);
  const double t = std::sqrt(std::atan2(g.sin_theta_h, g.cos_theta_h) * (2 / pi));
  return 1 / std::max(4 * g.cos_theta_d * g.sin_theta_d * g.sin_theta_h * pi * t, 1e-12);
}

}  // namespace

SampleSet collect_samples(const Lookup& lookup, int channels, int count) {
  SampleSet set;
  set.channels = channels;
  const auto n = static_cast<std::size_t>(count);
  set.wi.reserve(n);
  set.wo.reserve(n);
  set.weight.reserve(n);
  set.values.reserve(n * static_cast<std::size_t>(channels));
  std::vector<double> f(static_cast<std::size_t>(channels));
  EvenSequence around_mirror(0.5), around_retro(0.25);
  const long attempts = 20L * count;  // two pairs in three are below 85 degrees; masks may take most of those
  for (long i = 0; i < attempts && set.size() < n; ++i) {
    const bool retro = i % retro_period == retro_period - 1;
    const double* u = retro ? around_retro.next() : around_mirror.next();
    Vec3d wi, wo;
    geometry::directions_from_half_difference(u[0] * u[0] * (pi / 2), u[1] * (pi / 2), u[2] * (2 * pi), wi, wo);
    if (retro) wo = turned(wo);
    if (wi.z < min_cosine || wo.z < min_cosine) continue;
    if (!lookup(wi, wo, f)) continue;
    if (!std::all_of(f.begin(), f.end(), [](double v) { return std::isfinite(v); })) continue;
    const double drawn = (1 - retro_share) * density(wi, wo) + retro_share * density(wi, turned(wo));
    set.wi.push_back(wi);
    set.wo.push_back(wo);
    set.weight.push_back(std::pow(wi.z * wo.z / drawn, tempering));
    for (const double v : f) set.values.push_back(std::max(v, 0.0));
  }
  return set;
}

SampleSet collect_samples(const Measurement& m, int count) {
  const MeasurementInterpolator table(m);
  const auto lookup = [&](const Vec3d& wi, const Vec3d& wo, std::span<double> f) { return table.eval(wi, wo, f); };
  return collect_samples(lookup, m.channels.count, count);
}

}  // namespace brdf::fit
