// SPDX-License-Identifier: Apache-2.0
#include "support/direction_kinds.h"

#include "support/numeric_bound.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace brdf::test {

namespace {

constexpr double pi = std::numbers::pi;

Vec3f at_degrees(double theta, double phi) {
  const double t = theta * pi / 180;
  return {static_cast<float>(std::sin(t) * std::cos(phi)), static_cast<float>(std::sin(t) * std::sin(phi)),
          static_cast<float>(std::cos(t))};
}

const double usual_thetas[] = {0.5, 7, 23, 45, 61.7, 80, 88};
const double usual_phis[] = {0, 0.7, pi / 2, 2.2, pi, -1.9};
const double grazing_thetas[] = {89.9, 89.99, 89.999, 89.9999, 89.99999};

DirectionKind exactly_normal() {
  DirectionKind k{"wi, wo or both exactly normal", {}, {}};
  k.push({0, 0, 1}, {0, 0, 1});
  for (const double theta : usual_thetas)
    for (const double phi : usual_phis) {
      k.push({0, 0, 1}, at_degrees(theta, phi));
      k.push(at_degrees(theta, phi), {0, 0, 1});
    }
  for (const double theta : grazing_thetas) k.push({0, 0, 1}, at_degrees(theta, 0.3));
  return k;
}

DirectionKind near_normal() {
  DirectionKind k{"both within 1e-1 to 1e-7 of the normal", {}, {}};
  for (double e = 0.1; e > 5e-8; e *= 0.31)
    for (const double phi : usual_phis) {
      k.push(at_degrees(e * 57, phi), at_degrees(e * 40, 1.3));
      k.push(at_degrees(e * 57, phi), at_degrees(45, 0.4));
    }
  return k;
}

DirectionKind grazing() {
  DirectionKind k{"one or both at 89.9 to 89.99999 degrees", {}, {}};
  for (const double a : grazing_thetas)
    for (const double phi : usual_phis) {
      for (const double b : usual_thetas) {
        k.push(at_degrees(a, phi), at_degrees(b, 0.2));
        k.push(at_degrees(b, 0.2), at_degrees(a, phi));
      }
      for (const double b : grazing_thetas) k.push(at_degrees(a, 0.1), at_degrees(b, phi));
    }
  return k;
}

DirectionKind equal() {
  DirectionKind k{"wi = wo", {}, {}};
  for (const double phi : usual_phis) {
    for (const double a : usual_thetas) k.push(at_degrees(a, phi), at_degrees(a, phi));
    for (const double a : grazing_thetas) k.push(at_degrees(a, phi), at_degrees(a, phi));
  }
  return k;
}

DirectionKind mirrored() {
  DirectionKind k{"wo the mirror image of wi, down to grazing", {}, {}};
  for (const double phi : usual_phis) {
    for (const double a : usual_thetas) k.push(at_degrees(a, phi), at_degrees(a, phi + pi));
    for (const double a : grazing_thetas) {
      const Vec3f w = at_degrees(a, phi);
      k.push(w, {-w.x, -w.y, w.z});
      k.push(w, at_degrees(a, phi + pi));
    }
  }
  return k;
}

DirectionKind degenerate_half() {
  DirectionKind k{"opposite at the horizon: wi + wo almost 0", {}, {}};
  for (const double phi : usual_phis)
    for (const float z : {1e-3f, 1e-5f, 1e-7f, 1e-9f})
      for (const float turn : {0.0f, 1e-7f, 1e-5f, 1e-3f}) {
        const auto at = [&](double azimuth, float cosine) {
          const double sine = std::sqrt(1 - static_cast<double>(cosine) * static_cast<double>(cosine));
          return Vec3f(static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)), cosine);
        };
        const double other = phi + pi + static_cast<double>(turn);
        k.push(at(phi, z), at(other, z));
        k.push(at(phi, z), at(other, 3 * z));
      }
  return k;
}

DirectionKind seam() {
  DirectionKind k{"phi at the seam of -pi and pi", {}, {}};
  for (const double a : usual_thetas)
    for (const double b : usual_thetas)
      for (const float y : {0.0f, -0.0f, 1e-30f, -1e-30f, 1e-8f, -1e-8f, 1e-4f, -1e-4f}) {
        const Vec3f u = at_degrees(a, pi), v = at_degrees(b, pi);
        k.push({u.x, y, u.z}, {v.x, -y, v.z});
        k.push({u.x, y, u.z}, {-v.x, y, v.z});
      }
  return k;
}

DirectionKind one_plane() {
  DirectionKind k{"in one plane with the normal: phi_d 0 or pi", {}, {}};
  for (const double phi : usual_phis)
    for (const double a : usual_thetas)
      for (const double b : {0.51, 7.3, 23.0, 46.0, 79.0}) {
        k.push(at_degrees(a, phi), at_degrees(b, phi));
        k.push(at_degrees(a, phi), at_degrees(-b, phi));
        k.push(at_degrees(a, phi), at_degrees(b, phi + 1e-6));
      }
  return k;
}

DirectionKind denormal() {
  DirectionKind k{"denormal and tiny components", {}, {}};
  const float least = std::numeric_limits<float>::denorm_min();
  for (const float e : {least, 100 * least, std::numeric_limits<float>::min(), 1e-35f, 1e-25f, 1e-15f})
    for (const float sign : {1.0f, -1.0f})
      for (const double b : {0.0, 30.0, 70.0}) {
        k.push({sign * e, 0, 1}, at_degrees(b, 0.5));
        k.push({sign * e, e, 1}, {e, sign * e, 1});
        k.push({0.6f, sign * e, 0.8f}, at_degrees(b, 2));
        k.push({0.6f, sign * e, 0.8f}, {-0.6f, e, 0.8f});
      }
  return k;
}

DirectionKind everywhere() {
  DirectionKind k{"random pairs over the hemisphere", random_directions(3000, 21), random_directions(3000, 22)};
  return k;
}

}  // namespace

std::vector<DirectionKind> direction_kinds() {
  return {exactly_normal(), near_normal(), grazing(),  equal(),     mirrored(),
          degenerate_half(), seam(),       one_plane(), denormal(), everywhere()};
}

std::string pair_words(const Vec3f& wi, const Vec3f& wo) {
  const auto words = [](const Vec3f& w) {
    return numbers({static_cast<double>(w.x), static_cast<double>(w.y), static_cast<double>(w.z)});
  };
  return "wi " + words(wi) + ", wo " + words(wo);
}

}  // namespace brdf::test
