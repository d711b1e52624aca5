// SPDX-License-Identifier: Apache-2.0
// Fresnel's equations where they lose their digits: indices next to 1, grazing angles, the border of total reflection.
// Against the textbook's form in long double. Schlick's approximation beside them.
#include "support/numeric_bound.h"

#include <brdf/fresnel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <string>
#include <vector>

namespace brdf::test {
namespace {

const char* const group = "Fresnel";

struct Reference {
  long double reflected, transmitted, cos_t;
};

/// Born and Wolf, Principles of Optics, sec. 1.5.2, eq. 20 and 21, and 1.5.3, eq. 33.
Reference reference(float cos_i, float eta) {
  if (eta == 1) return {0, 1, cos_i};  // there is no interface, and 1 - (1 - c^2) would lose c at grazing even here
  const long double c = cos_i, n = eta, sin2_t = (1 - c * c) / (n * n);
  if (sin2_t >= 1) return {1, 0, 0};
  const long double t = std::sqrt(1 - sin2_t);
  const long double r_s = (c - n * t) / (c + n * t), r_p = (n * c - t) / (n * c + t);
  const long double t_s = 2 * c / (c + n * t), t_p = 2 * c / (n * c + t);
  return {(r_s * r_s + r_p * r_p) / 2, n * t / c * (t_s * t_s + t_p * t_p) / 2, t};
}

/// Relative indices: next to 1, water, glass, diamond, 4, and all of them from the other side.
std::vector<float> indices() {
  std::vector<float> all{1.0f, 1 + 1e-7f, 1 - 1e-7f, 1 + 1e-5f, 1 - 1e-5f};
  for (const float n : {1.001f, 1.1f, 1.33f, 1.5f, 2.42f, 4.0f, 10.0f}) {
    all.push_back(n);
    all.push_back(1 / n);
  }
  return all;
}

/// From the normal to 89.99999 degrees.
std::vector<float> cosines() {
  std::vector<float> all;
  for (int tenth = 0; tenth < 900; ++tenth) all.push_back(static_cast<float>(std::cos(tenth * std::numbers::pi / 1800)));
  for (double from_horizon = 0.1; from_horizon > 0.9e-5; from_horizon *= 0.8)
    all.push_back(static_cast<float>(std::sin(from_horizon * std::numbers::pi / 180)));
  all.push_back(static_cast<float>(std::sin(1e-5 * std::numbers::pi / 180)));
  return all;
}

NumericBound reflected(group, "relative IOR 1 +- 1e-7 to 10 and 1/10, 0 to 89.99999 degrees: R", "relative", 1e-7);
NumericBound transmitted(group, "the same: T", "relative", 1e-7);
NumericBound refracted(group, "the same: cosine of the refracted direction", "relative", 1e-7);
NumericBound energy(group, "the same: R + T from 1", "absolute", 1.2e-7);

TEST(Fresnel, AgainstLongDouble) {
  for (const float n : indices())
    for (const float c : cosines()) {
      const FresnelSplit f = fresnel_split(c, n);
      const Reference r = reference(c, n);
      const auto where = [&] { return "IOR and cosine " + numbers({static_cast<double>(n), static_cast<double>(c)}); };
      const auto apart = [](float found, long double expected) {
        if (expected == 0) return found == 0 ? 0.0 : 1.0;
        return static_cast<double>(std::fabs(static_cast<long double>(found) - expected) / expected);
      };
      reflected.see(apart(f.reflected, r.reflected), where);
      transmitted.see(apart(f.transmitted, r.transmitted), where);
      refracted.see(apart(f.cos_t, r.cos_t), where);
      energy.see(std::fabs(static_cast<double>(f.reflected) + static_cast<double>(f.transmitted) - 1), where);
      EXPECT_EQ(fresnel_dielectric(c, n), f.reflected);
    }
  for (const NumericBound* b : {&reflected, &transmitted, &refracted, &energy}) b->check();
}

NumericBound threshold(group, "total internal reflection, 200 floats on both sides of its border: misjudged", "count", 0);
NumericBound rises(group, "the same: R that falls towards the border", "count", 0);

TEST(Fresnel, TotalReflectionBeginsWhereItShould) {
  for (const float n : indices()) {
    if (!(n < 1)) continue;
    float c = static_cast<float>(std::sqrt((1 - static_cast<double>(n)) * (1 + static_cast<double>(n))));
    for (int k = 0; k < 100; ++k) c = std::nextafter(c, 2.0f);
    float before = 0;
    for (int k = 0; k < 200; ++k, c = std::nextafter(c, 0.0f)) {
      const long double g2 = (static_cast<long double>(n) - 1) * (static_cast<long double>(n) + 1) + static_cast<long double>(c) * static_cast<long double>(c);
      const FresnelSplit f = fresnel_split(c, n);
      const auto where = [&] { return "IOR and cosine " + numbers({static_cast<double>(n), static_cast<double>(c)}); };
      threshold.see((f.transmitted > 0) == (g2 > 0) ? 0 : 1, where);
      rises.see(f.reflected >= before ? 0 : 1, where);
      before = f.reflected;
    }
  }
  threshold.check();
  rises.check();
}

NumericBound strange(group, "arguments outside [0, 1] and NaN: values outside [0, 1]", "count", 0);

TEST(Fresnel, ClampsItsArguments) {
  const float nan = std::nanf("");
  for (const float n : indices())
    for (const float c : {-1.0f, -1e-30f, 0.0f, 1e-45f, 1e-30f, 1.0f, 1.5f, INFINITY, nan}) {
      const FresnelSplit f = fresnel_split(c, n);
      for (const float v : {f.reflected, f.transmitted, f.cos_t, schlick_dielectric(c, n), schlick(c, 0.04f)})
        strange.see(v >= 0 && v <= 1 ? 0 : 1, [&] { return "IOR and cosine " + numbers({static_cast<double>(n), static_cast<double>(c)}); });
    }
  strange.check();
}

/// How far Schlick's approximation is from the equations: no error of arithmetic, but what its user accepts.
struct Approximated {
  float eta;
  const char* name;
  double bound;
};
constexpr Approximated approximated[] = {{1.1f, "1.1", 0.212},       {1.33f, "1.33", 0.061},         {1.5f, "1.5", 0.037},
                                         {2.0f, "2", 0.046},         {2.42f, "2.42", 0.077},         {4.0f, "4", 0.203},
                                         {1 / 1.33f, "1 / 1.33", 0.061}, {1 / 1.5f, "1 / 1.5", 0.037}, {1 / 2.42f, "1 / 2.42", 0.077},
                                         {0.25f, "1 / 4", 0.203}};

std::deque<NumericBound> declare() {
  std::deque<NumericBound> all;
  for (const Approximated& a : approximated)
    all.emplace_back(group, std::string("Schlick's approximation, relative IOR ") + a.name, "absolute", a.bound);
  return all;
}
std::deque<NumericBound> schlick_error = declare();

TEST(Fresnel, SchlickIsThisFarAway) {
  for (std::size_t k = 0; k < std::size(approximated); ++k) {
    const float n = approximated[k].eta;
    for (const float c : cosines())
      schlick_error[k].see(std::fabs(static_cast<double>(schlick_dielectric(c, n)) - static_cast<double>(fresnel_dielectric(c, n))),
                           [&] { return numbers({std::round(std::acos(static_cast<double>(c)) * 1800 / std::numbers::pi) / 10}) + " degrees"; });
    schlick_error[k].check();
    EXPECT_NEAR(schlick_dielectric(1, n), fresnel_dielectric(1, n), 1e-7) << n;
  }
}

}  // namespace
}  // namespace brdf::test
