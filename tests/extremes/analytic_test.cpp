// SPDX-License-Identifier: Apache-2.0
// Analytic materials at the smallest roughness, at grazing angles, on the horizon, and for what is no direction.
#include "support/analytic_models.h"
#include "support/direction_batch.h"
#include "support/numeric_bound.h"

#include <brdf/fresnel.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace brdf::test {
namespace {

const char* const group = "Analytic materials";
constexpr float below_one = 0x1.fffffep-1f, nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

/// Every model, and the narrowest ones.
std::vector<NamedModel> extreme_models() {
  std::vector<NamedModel> all = all_models();
  all.push_back({"alpha 1e-4", GgxReflector{1e-4f, 1e-4f, {1}}});
  all.push_back({"alpha 1e-4, compensated", GgxReflector{1e-4f, 1e-4f, {0.5f}, true}});
  all.push_back({"alpha 1e-4 and 1", GgxReflector{1e-4f, 1, {1}}});
  all.push_back({"alpha 1e-4 and 2e-4", GgxReflector{1e-4f, 2e-4f, {1}}});
  all.push_back({"black", GgxReflector{0.5f, 0.5f, {0}, true}});
  all.push_back({"index 1 + 1e-7", Dielectric{1 + 1e-7f, 1}});
  all.push_back({"index 1 - 1e-7", Dielectric{1 - 1e-7f, 1}});
  all.push_back({"index 10", Dielectric{10, 1}});
  return all;
}

/// Directions to the last float above the horizon, on it, below it, and none at all.
std::vector<Vec3f> extreme_directions() {
  std::vector<Vec3f> all{{0, 0, 0}, {nan, 0, 1}, {0, 0, nan}, {0, 0, infinity}, {infinity, 0, 1}, {1e30f, 1e30f, 1e30f}, {0, 0, -infinity}};
  for (const float z : {1.0f, 0.7f, 1e-3f, 1.7453e-7f, 1e-20f, 1e-38f, 1e-45f, 0.0f, -0.0f, -1e-45f, -1e-7f, -0.5f, -1.0f})
    for (const float azimuth : {0.0f, 0.9f, 1.5707964f, 3.0f}) {
      const float s = std::sqrt(std::max(1 - z * z, 0.0f));
      all.push_back({s * std::cos(azimuth), s * std::sin(azimuth), z});
    }
  return all;
}

NumericBound unsound(group, "any direction, any u: samples and values that are not sound", "count", 0);

bool is_sound(const Material& m, const Vec3f& wo, const Sample& s, const std::vector<float>& weight) {
  const bool quiet = s.flags == sample_none;
  for (const float w : weight)
    if (!std::isfinite(w) || w < 0 || (quiet && w != 0)) return false;
  if (quiet) return s.pdf == 0 && s.wi == Vec3f(0, 0, 0);
  if (!std::isfinite(s.pdf) || s.pdf <= 0 || !std::isfinite(s.eta) || (s.flags & ~m.scatter_flags()) != 0) return false;
  const float length = std::sqrt(s.wi.x * s.wi.x + s.wi.y * s.wi.y + s.wi.z * s.wi.z);
  if ((s.flags & sample_delta) == 0 && std::fabs(length - 1) > 1e-5f) return false;
  return (s.flags & sample_transmission) != 0 ? s.wi.z * wo.z < 0 || std::fabs(wo.z) < 1e-20f : (s.wi.z > 0) == (wo.z > 0);
}

TEST(AnalyticExtremes, EverythingIsANumber) {
  const std::vector<Vec3f> directions = extreme_directions();
  for (const NamedModel& named : extreme_models()) {
    const Material m = Material::from_analytic(named.model);
    const auto channels = static_cast<std::size_t>(m.channels());
    std::vector<float> weight(channels), f(channels);
    for (const Vec3f& wo : directions) {
      const auto where = [&] { return named.name + " wo " + numbers({static_cast<double>(wo.x), static_cast<double>(wo.y), static_cast<double>(wo.z)}); };
      for (const float a : {0.0f, 0.5f, below_one, nan})
        for (const float b : {0.0f, 1e-30f, 0.25f, below_one, 1.0f, nan})
          for (const float c : {0.0f, 1e-30f, 0.5f, below_one, 1.0f, -1.0f, nan})
            for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
              const Sample s = m.sample(wo, {a, b, c}, weight, mode);
              unsound.see(is_sound(m, wo, s, weight) ? 0 : 1, where);
            }
      for (const Vec3f& wi : directions) {
        const float pdf = m.eval_pdf(wi, wo, f);
        bool sound = std::isfinite(pdf) && pdf >= 0;
        for (const float v : f) sound = sound && std::isfinite(v) && v >= 0 && ((wi.z > 0 && wo.z > 0) || v == 0);
        unsound.see(sound ? 0 : 1, where);
      }
      m.albedo(wo, f);
      for (const float v : f) unsound.see(v >= 0 && v <= 1.001f ? 0 : 1, where);
    }
  }
  unsound.check();
}

/// f of <brdf/analytic.h> with F = 1, from floats taken as exact numbers.
long double value(const GgxReflector& m, const Vec3f& wi, const Vec3f& wo) {
  using Number = long double;
  const Number ax = m.alpha_x, ay = m.alpha_y;
  const Number x = static_cast<Number>(wi.x) + static_cast<Number>(wo.x), y = static_cast<Number>(wi.y) + static_cast<Number>(wo.y),
               z = static_cast<Number>(wi.z) + static_cast<Number>(wo.z);
  const Number q = (x * x / (ax * ax) + y * y / (ay * ay) + z * z) / (x * x + y * y + z * z);
  const auto lambda = [&](const Vec3f& w) {
    const Number u = ax * static_cast<Number>(w.x), v = ay * static_cast<Number>(w.y), c = w.z;
    return (std::sqrt(1 + (u * u + v * v) / (c * c)) - 1) / 2;
  };
  return 1 / (std::numbers::pi_v<Number> * ax * ay * q * q) / (1 + lambda(wi) + lambda(wo)) / (4 * static_cast<Number>(wi.z) * static_cast<Number>(wo.z));
}

NumericBound facets(group, "GGX of two roughnesses, 1e-4 to 1, to 89.99999 degrees: f", "relative", 2e-7);
NumericBound weights(group, "the same, and one roughness with compensation: weight against f cos / pdf of the drawn direction", "relative", 1e-5);

TEST(AnalyticExtremes, FacetsAgainstLongDouble) {
  const DirectionBatch u = random_numbers(400, 21);
  for (const float ax : {1e-4f, 1e-3f, 0.03f, 0.3f, 1.0f})
    for (const float ay : {1e-4f, 1e-2f, 0.31f, 1.0f})
      for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9, 89.99999}) {
        const GgxReflector model{ax, ay, {1}, ax == ay};
        const Material m = Material::from_analytic(model);
        const Vec3f wo = direction_at(std::cos(degrees * std::numbers::pi / 180), 0.6);
        for (std::size_t i = 0; i < u.size(); ++i) {
          float weight = 0, f = 0;
          const Sample s = m.sample(wo, u[i], {&weight, 1});
          const float pdf = m.eval_pdf(s.wi, wo, {&f, 1});
          const auto where = [&] { return "alpha " + numbers({static_cast<double>(ax), static_cast<double>(ay)}) + ", " + numbers({degrees}) + " degrees"; };
          const double scaled = static_cast<double>(f) * static_cast<double>(s.wi.z) / static_cast<double>(pdf);
          // cosines below 1e-9 count as that
          if (s.wi.z > 1e-8f) weights.see(std::fabs(scaled - static_cast<double>(weight)) / std::max(scaled, 1e-12), where);
          if (ax == ay || s.wi.z < 1e-8f) continue;
          const long double expected = value(model, s.wi, wo);
          facets.see(static_cast<double>(std::fabs(static_cast<long double>(f) / expected - 1)), where);
        }
      }
  facets.check();
  weights.check();
}

NumericBound snell(group, "dielectrics, IOR 1 +- 1e-7 to 10, to 89.99999 degrees, both sides: sin theta_t eta from sin theta_i", "absolute", 5e-7);
NumericBound shares(group, "the same: probabilities of reflection and transmission, sum from 1", "absolute", 1.2e-7);

TEST(AnalyticExtremes, InterfacesObeySnell) {
  for (const float ior : {1 + 1e-7f, 1 - 1e-7f, 1.0f, 1.33f, 1.5f, 0.75f, 4.0f, 0.25f, 10.0f})
    for (const double degrees : {0.0, 1e-3, 10.0, 40.0, 41.8, 60.0, 89.0, 89.9, 89.99999})
      for (const float side : {1.0f, -1.0f}) {
        const Material m = Material::from_analytic(Dielectric{ior, 1});
        Vec3f wo = direction_at(std::cos(degrees * std::numbers::pi / 180), 0.6);
        wo.z *= side;
        float weight = 0;
        const Sample back = m.sample(wo, {0, 0, 0}, {&weight, 1}), through = m.sample(wo, {below_one, 0, 0}, {&weight, 1});
        const auto where = [&] { return "IOR " + numbers({static_cast<double>(ior)}) + ", " + numbers({degrees}) + " degrees"; };
        const bool reflects = (back.flags & sample_reflection) != 0, transmits = (through.flags & sample_transmission) != 0;
        if (!transmits) continue;
        const double eta = static_cast<double>(through.eta);
        snell.see(std::max(std::fabs(static_cast<double>(through.wi.x) * eta + static_cast<double>(wo.x)),
                           std::fabs(static_cast<double>(through.wi.y) * eta + static_cast<double>(wo.y))) / std::max(eta, 1.0), where);
        shares.see(std::fabs((reflects ? static_cast<double>(back.pdf) : 0) + static_cast<double>(through.pdf) - 1), where);
      }
  snell.check();
  shares.check();
}

}  // namespace
}  // namespace brdf::test
