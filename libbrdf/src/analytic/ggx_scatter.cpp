// SPDX-License-Identifier: Apache-2.0
#include "analytic/ggx_scatter.h"

#include "analytic/specular.h"
#include "lobes/ggx.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brdf::analytic {

namespace {

/// Cosines below this count as this, as in eval::pair_terms: no quotient leaves the range of float.
constexpr double min_cosine = 1e-9;

/// Into [0, 1), NaN to 0.
double unit_interval(float u) noexcept { return std::min(std::max(0.0, static_cast<double>(u)), 1 - 0x1p-24); }

bool above_horizon(const Vec3f& w) noexcept {
  return w.z > 0 && w.x * w.x + w.y * w.y + w.z * w.z < max_direction_norm2;
}

Vec3f rounded(double x, double y, double z) noexcept {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::max(z, min_cosine))};
}

Vec3f draw_cosine(double u1, double u2) noexcept {
  const double r = std::sqrt(u1), phi = 2 * lobes::pi * u2;
  return rounded(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u1));
}

}  // namespace

/// All of it but `facets` and `image` is the same bits after an exchange of the directions.
struct GgxScatter::Pair {
  bool valid = false;
  double cos_i = 0, cos_o = 0;
  double slope_i = 0, slope_o = 0;  ///< cos (1 + 2 Lambda)
  double facets = 0, image = 0;     ///< D of the half vector, and of that with wi folded below the horizon
  double schlick = 0;

  Pair(const GgxScatter& s, const Vec3f& wi, const Vec3f& wo) noexcept {
    if (!above_horizon(wi) || !above_horizon(wo)) return;
    valid = true;
    const Vec3d i(wi), o(wo);
    cos_i = std::max(i.z, min_cosine);
    cos_o = std::max(o.z, min_cosine);
    const auto slope = [&s](double x, double y, double z) {
      x *= s.ax_;
      y *= s.ay_;
      return std::sqrt(x * x + y * y + z * z);
    };
    slope_i = slope(i.x, i.y, cos_i);
    slope_o = slope(o.x, o.y, cos_o);
    const double x = i.x + o.x, y = i.y + o.y, xy = x * x + y * y;
    const double sx = x * s.inv_ax_, sy = y * s.inv_ay_, slope2 = sx * sx + sy * sy;
    const auto ndf = [&](double z) {
      const double q = (xy + z * z) / (slope2 + z * z);
      return s.peak_ * q * q;
    };
    const double sum = cos_i + cos_o, rise = cos_o - cos_i;
    facets = ndf(sum);
    image = rise > 0 ? ndf(rise) : 0;
    const double s2 = xy + sum * sum, dx = i.x - o.x, dy = i.y - o.y, d2 = dx * dx + dy * dy + rise * rise;
    const double inv = 1 / (s2 + d2);
    schlick = lobes::schlick_weight(std::sqrt(d2 * inv), std::sqrt(s2 * inv));
  }

  /// G2 / (4 cos_i cos_o).
  double visibility() const noexcept { return 0.5 / (slope_i * cos_o + slope_o * cos_i); }
};

GgxScatter::GgxScatter(const GgxReflector& m)
    : ax_(static_cast<double>(m.alpha_x)),
      ay_(static_cast<double>(m.alpha_y)),
      inv_ax_(1 / ax_),
      inv_ay_(1 / ay_),
      peak_(1 / (lobes::pi * ax_ * ay_)),
      f0_(m.f0),
      color_(m.f0.size(), 0.0f) {
  if (m.multiple_scattering) energy_.emplace(ax_);
  for (std::size_t c = 0; c < f0_.size(); ++c) {
    const double mean = schlick_mean(static_cast<double>(f0_[c]), 1);
    if (energy_) color_[c] = static_cast<float>(energy_->compensation_color(mean));
    mean_fresnel_ += mean / static_cast<double>(f0_.size());
    mean_color_ += static_cast<double>(color_[c]) / static_cast<double>(f0_.size());
  }
}

GgxScatter::Parts GgxScatter::value(const Pair& p) const noexcept {
  Parts v;
  const double shape = p.facets * p.visibility();
  v.plain = shape * (1 - p.schlick);
  v.white = shape * p.schlick;
  if (energy_) v.further = energy_->compensation(p.cos_i, p.cos_o);
  return v;
}

void GgxScatter::eval(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept {
  const Pair p(*this, wi, wo);
  const Parts v = p.valid ? value(p) : Parts{};
  for (std::size_t c = 0; c < f0_.size(); ++c) f[c] = static_cast<float>(v.of(static_cast<double>(f0_[c]), static_cast<double>(color_[c])));
}

void GgxScatter::eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept {
  for (std::size_t k = 0; k < wi.size; ++k) {
    const Pair p(*this, {wi.x[k], wi.y[k], wi.z[k]}, {wo.x[k], wo.y[k], wo.z[k]});
    const Parts v = p.valid ? value(p) : Parts{};
    for (std::size_t c = 0; c < f0_.size(); ++c)
      f.data[c * f.stride + k] = static_cast<float>(v.of(static_cast<double>(f0_[c]), static_cast<double>(color_[c])));
  }
}

/// Visible normals are drawn with density D max(0, wo . h) G1 / cos_o (Heitz 2018, eq. 3) and dh = dwi / (4 wo . h) (Walter
/// et al. 2007, eq. 14), so a reflected direction has D G1 / (4 cos_o) = D / (2 (cos_o + slope_o)).
double GgxScatter::facet_density(const Pair& p) const noexcept { return 0.5 * (p.facets + p.image) / (p.cos_o + p.slope_o); }

double GgxScatter::cosine_share(double cos_o) const noexcept {
  if (!energy_) return 0;
  const double loss = energy_->loss(cos_o), further = mean_color_ * loss;
  return further > 0 ? further / (further + mean_fresnel_ * (1 - loss)) : 0;
}

double GgxScatter::density(const Pair& p) const noexcept {
  const double share = cosine_share(p.cos_o);
  return (1 - share) * facet_density(p) + share * p.cos_i / lobes::pi;
}

float GgxScatter::pdf(const Vec3f& wi, const Vec3f& wo) const noexcept {
  const Pair p(*this, wi, wo);
  return p.valid ? static_cast<float>(density(p)) : 0.0f;
}

/// Dupuy and Benyoub 2023 (Sampling Visible GGX Normals with Spherical Caps), listing 3: in the space where the surface is
/// a hemisphere, h = c + wo with c uniform on the cap of the sphere above -wo.z. The height of c and of h come from u2
/// without the differences that would cancel for a narrow lobe.
Vec3f GgxScatter::draw_facet(const Vec3f& wo, double u1, double u2) const noexcept {
  const Vec3d o(wo);
  double wx = ax_ * o.x, wy = ay_ * o.y, wz = std::max(o.z, min_cosine);
  const double inv = 1 / std::sqrt(wx * wx + wy * wy + wz * wz);
  wx *= inv;
  wy *= inv;
  wz *= inv;
  const double depth = u2 * (1 + wz);  // of c below the pole
  const double sine = std::sqrt(std::max(depth * (2 - depth), 0.0)), phi = 2 * lobes::pi * u1;
  const double x = ax_ * (sine * std::cos(phi) + wx), y = ay_ * (sine * std::sin(phi) + wy), z = (1 - u2) * (1 + wz);
  const double twice = 2 * (o.x * x + o.y * y + o.z * z) / (x * x + y * y + z * z);
  const double rx = twice * x - o.x, ry = twice * y - o.y, rz = std::abs(twice * z - o.z);
  const double length = 1 / std::sqrt(rx * rx + ry * ry + rz * rz);
  return rounded(rx * length, ry * length, rz * length);
}

GgxScatter::Parts GgxScatter::facet_weight(const Vec3f& wo, const Vec3f& u) const noexcept {
  if (!above_horizon(wo)) return {};
  const Pair p(*this, draw_facet(wo, unit_interval(u.y), unit_interval(u.z)), wo);
  if (!p.valid) return {};
  // f cos_i / density, with D cancelled
  const double weight = 2 * p.cos_i * p.visibility() * (p.cos_o + p.slope_o) * p.facets / (p.facets + p.image);
  return {weight * (1 - p.schlick), weight * p.schlick, 0};
}

double GgxScatter::albedo(std::size_t channel, const Vec3f& wo, const Parts& facets) const noexcept {
  if (!above_horizon(wo)) return 0;
  Parts all = facets;
  if (energy_) all.further = energy_->loss(std::max(static_cast<double>(wo.z), min_cosine));
  return all.of(static_cast<double>(f0_[channel]), static_cast<double>(color_[channel]));
}

Sample GgxScatter::sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode) const noexcept {
  Sample s;
  std::fill(weight.begin(), weight.end(), 0.0f);
  if (!above_horizon(wo)) return s;
  const double u1 = unit_interval(u.y), u2 = unit_interval(u.z);
  const bool cosine = unit_interval(u.x) < cosine_share(std::max(static_cast<double>(wo.z), min_cosine));
  const Vec3f wi = cosine ? draw_cosine(u1, u2) : draw_facet(wo, u1, u2);
  const Pair p(*this, wi, wo);
  if (!p.valid) return s;
  const double pdf = density(p), scale = p.cos_i / pdf;
  const Parts v = value(p);
  for (std::size_t c = 0; c < f0_.size(); ++c)
    weight[c] = static_cast<float>(scale * v.of(static_cast<double>(f0_[c]), static_cast<double>(color_[c])));
  s.wi = wi;
  s.pdf = static_cast<float>(pdf);
  s.flags = flags;
  return s;
}

}  // namespace brdf::analytic
