// SPDX-License-Identifier: Apache-2.0
#include <brdf/measurement.h>

#include "ingest/half_difference_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace brdf {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double grazing =
    85 * pi / 180;  ///< beyond it no set-up measures well, and f = value / cos grows without bound
constexpr int pair_count = 20000;
constexpr int albedo_angles = 16;     ///< 0 to 85 degrees
constexpr int albedo_samples = 4096;  ///< of each of the two techniques, per angle

/// Point n of the R_D sequence (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"): multiples
/// of the powers of 1/g, where g is the root of g^(D+1) = g + 1.
template <std::size_t D>
class LowDiscrepancy {
 public:
  LowDiscrepancy() noexcept {
    double g = 1.5;
    for (int i = 0; i < 60; ++i) g = std::pow(1 + g, 1.0 / (D + 1));
    double power = 1;
    for (double& step : steps_) step = power /= g;
  }
  std::array<double, D> point(int n) const noexcept {
    std::array<double, D> p;
    for (std::size_t i = 0; i < D; ++i) {
      const double x = 0.5 + (n + 1) * steps_[i];
      p[i] = x - std::floor(x);
    }
    return p;
  }

 private:
  std::array<double, D> steps_;
};

Vec3d direction(double cos_theta, double phi) noexcept {
  const double sin_theta = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta};
}

Vec3d mirrored(const Vec3d& w) noexcept { return {w.x, -w.y, w.z}; }

/// Mean over channels of |log(1 + a cos) - log(1 + b cos)|.
double log_difference(std::span<const double> a, std::span<const double> b, double cosine) noexcept {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += std::abs(std::log1p(a[c] * cosine) - std::log1p(b[c] * cosine));
  return sum / static_cast<double>(a.size());
}

double largest(std::span<const double> f) noexcept { return *std::max_element(f.begin(), f.end()); }

class Examiner {
 public:
  Examiner(const Measurement& m, IngestReport& report)
      : interpolator_(m), report_(report), f_(static_cast<std::size_t>(m.channels.count)), g_(f_.size()) {}

  /// Both asymmetries over pairs that are uniform in solid angle within 85 degrees.
  void symmetries() {
    const LowDiscrepancy<3> sequence;
    const double lowest = std::cos(grazing);
    int exchanged = 0, reflected = 0;
    for (int n = 0; n < pair_count; ++n) {
      const auto u = sequence.point(n);
      const Vec3d wi = direction(lowest + (1 - lowest) * u[0], 0);
      const Vec3d wo = direction(lowest + (1 - lowest) * u[1], 2 * pi * u[2]);
      if (!interpolator_.eval(wi, wo, f_)) continue;
      report_.max_value = std::max(report_.max_value, largest(f_));
      if (interpolator_.eval(wo, wi, g_)) {
        report_.reciprocity_asymmetry += log_difference(f_, g_, wi.z);
        ++exchanged;
      }
      if (interpolator_.eval(mirrored(wi), mirrored(wo), g_)) {
        report_.mirror_asymmetry += log_difference(f_, g_, wi.z);
        ++reflected;
      }
    }
    if (exchanged > 0) report_.reciprocity_asymmetry /= exchanged;
    if (reflected > 0) report_.mirror_asymmetry /= reflected;
  }

  /// Largest directional albedo: for a fixed wo the integral of f cos_i over wi.
  void albedo() {
    for (int i = 0; i < albedo_angles; ++i) {
      const double theta = grazing * i / (albedo_angles - 1);
      report_.max_albedo = std::max(report_.max_albedo, albedo({std::sin(theta), 0, std::cos(theta)}));
    }
  }

 private:
  /// Half of the samples follow the cosine, half a half vector with density 1 in sqrt(theta_h), which finds every
  /// peak; joined by the balance heuristic (Veach and Guibas 1995).
  double albedo(const Vec3d& wo) {
    const LowDiscrepancy<2> sequence;
    sums_.assign(f_.size(), 0.0);
    for (int n = 0; n < albedo_samples; ++n) {
      const auto u = sequence.point(n);
      add_albedo_sample(direction(std::sqrt(u[0]), 2 * pi * u[1]), wo);
      const Vec3d h = direction(std::cos(u[0] * u[0] * (pi / 2)), 2 * pi * u[1]);
      add_albedo_sample(2 * (wo.x * h.x + wo.y * h.y + wo.z * h.z) * h - wo, wo);
    }
    return largest(sums_) / albedo_samples;
  }

  void add_albedo_sample(const Vec3d& wi, const Vec3d& wo) {
    if (!(wi.z > 0) || !interpolator_.eval(wi, wo, f_)) return;
    if (wi.z >= std::cos(grazing)) report_.max_value = std::max(report_.max_value, largest(f_));
    const double density = wi.z / pi + half_vector_density(wi, wo);
    for (std::size_t c = 0; c < f_.size(); ++c) sums_[c] += f_[c] * wi.z / density;
  }

  /// Density over wi of h with u = sqrt(2 theta_h / pi) uniform and any azimuth, reflected: dwi = 4 (wo.h) dh.
  static double half_vector_density(const Vec3d& wi, const Vec3d& wo) noexcept {
    const Vec3d s = wi + wo;
    const double rho = std::sqrt(s.x * s.x + s.y * s.y), length = std::sqrt(rho * rho + s.z * s.z);
    constexpr double pole = 1e-9;
    const double theta = std::max(std::atan2(rho, s.z), pole);
    const double over_h = 1 / (2 * pi * std::sin(theta) * std::sqrt(2 * pi * theta));
    return over_h / (2 * length);  // |wi + wo| = 2 wo.h
  }

  MeasurementInterpolator interpolator_;
  IngestReport& report_;
  std::vector<double> f_, g_, sums_;
};

void count_cells(const HalfDifferenceTable& t, std::size_t channels, IngestReport& report) {
  report.cells = t.valid.size();
  std::uint64_t valid = 0, negative = 0;
  const ingest::HalfDifferenceGrid grid(t);
  grid.for_each_cell([&](std::size_t cell, const Vec3d& wi, const Vec3d& wo) {
    if (t.valid[cell] == 0) return;
    ++valid;
    const std::span values(t.values.data() + cell * channels, channels);
    for (const float v : values) negative += v < 0 ? 1 : 0;
    if (std::min(wi.z, wo.z) < std::cos(grazing)) return;
    report.max_value = std::max(report.max_value, double{*std::max_element(values.begin(), values.end())});
  });
  report.invalid_fraction = 1 - static_cast<double>(valid) / static_cast<double>(report.cells);
  if (valid > 0) report.negative_fraction = static_cast<double>(negative) / static_cast<double>(valid * channels);
}

void count_cells(const VisibleNormalTable& t, std::size_t channels, IngestReport& report) {
  report.cells = t.values.size() / channels;
  const auto negative = std::count_if(t.values.begin(), t.values.end(), [](float v) { return v < 0; });
  report.negative_fraction = static_cast<double>(negative) / static_cast<double>(t.values.size());
}

}  // namespace

IngestReport report(const Measurement& m) {
  IngestReport result;
  Examiner examiner(m, result);  // also checks that the sizes of the table agree
  const auto channels = static_cast<std::size_t>(m.channels.count);
  std::visit([&](const auto& table) { count_cells(table, channels, result); }, m.table);
  result.numbers = result.cells * channels;
  examiner.symmetries();
  examiner.albedo();
  return result;
}

}  // namespace brdf
