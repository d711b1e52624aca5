// SPDX-License-Identifier: Apache-2.0
// Profiles as scenes of one kind would give them: every pair that a condition accepts, by what it contributes.
#pragma once

#include <brdf/measurement.h>
#include <brdf/profile.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::test {

/// Pairs evenly spread over both hemispheres, as far as `asked(wi, wo)` holds, with contribution f cos_i cos_o.
template <class Asked>
MaterialProfile made_profile(const Measurement& m, Asked&& asked, int pairs = 400000) {
  const MeasurementInterpolator reference(m);
  std::vector<double> f(static_cast<std::size_t>(m.channels.count));
  ProfileRecorder recorder({"made"});
  const auto turn = [](double ratio, int i) { return std::fmod(0.5 + ratio * i, 1.0); };
  for (int i = 0; i < pairs; ++i) {
    // theta_h and theta_d as tables have them, so that narrow lobes are met; the weight makes up for it
    const double u = turn(0.8191725134, i), theta_h = u * u * std::numbers::pi / 2, theta_d = turn(0.6710436067, i) * std::numbers::pi / 2;
    const double phi = turn(0.5497004779, i) * 2 * std::numbers::pi;
    const double ch = std::cos(theta_h), sh = std::sin(theta_h), cd = std::cos(theta_d), sd = std::sin(theta_d);
    const double x = sd * std::cos(phi), y = sd * std::sin(phi);
    const Vec3d wi(ch * x + sh * cd, y, ch * cd - sh * x), wo(-ch * x + sh * cd, -y, ch * cd + sh * x);
    if (wi.z < 0.03 || wo.z < 0.03 || !asked(wi, wo) || !reference.eval(wi, wo, f)) continue;
    double mean = 0;
    for (const double v : f) mean += v / static_cast<double>(f.size());
    recorder.record(0, ProfileOperation::eval, Vec3f(wi), Vec3f(wo), mean * wi.z * wo.z * u * sh * sd * cd);
  }
  recorder.first_hit(0, 100);
  return recorder.profile().at("made");
}

/// Half the angle between the directions, and that of the half vector; radians.
inline double difference_angle(const Vec3d& wi, const Vec3d& wo) noexcept {
  const Vec3d s = wi + wo, d = wi - wo;
  return std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z));
}
inline double half_angle(const Vec3d& wi, const Vec3d& wo) noexcept {
  const Vec3d s = wi + wo;
  return std::atan2(std::hypot(s.x, s.y), s.z);
}

}  // namespace brdf::test
