// SPDX-License-Identifier: Apache-2.0
// Evaluates and samples a material of known values through the installed headers and brdf::decode alone.

#include <brdf/error.h>
#include <brdf/material.h>
#include <brdf/version.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>

namespace {

int failures = 0;

void expect_near(const char* what, double found, double expected, double tolerance) {
  if (std::abs(found - expected) <= tolerance) return;
  std::printf("FAILED %s: %.9g, expected %.9g\n", what, found, expected);
  ++failures;
}

void expect(const char* what, bool holds) {
  if (holds) return;
  std::printf("FAILED %s\n", what);
  ++failures;
}

brdf::LobeSet lambert(double r, double g, double b) {
  brdf::Lobe lobe;
  lobe.kind = brdf::LobeKind::lambert;
  lobe.color = {r, g, b};
  return {3, {lobe}};
}

brdf::LobeSet mirror_like(double alpha, double f0) {
  brdf::Lobe lobe;
  lobe.kind = brdf::LobeKind::ggx;
  lobe.alpha = alpha;
  lobe.color = {f0};
  return {1, {lobe}};
}

}  // namespace

int main() {
  const double pi = std::acos(-1.0);
  const brdf::Vec3f up{0, 0, 1}, wo{0.6f, 0, 0.8f};

  // f of a Lambertian reflector is its reflectance over pi.
  const brdf::Material diffuse = brdf::Material::from_lobes(lambert(0.5, 0.25, 1.0));
  std::array<float, 3> f{};
  diffuse.eval(up, wo, f);
  expect_near("lambert f, channel 0", f[0], 0.5 / pi, 1e-6);
  expect_near("lambert f, channel 1", f[1], 0.25 / pi, 1e-6);
  expect_near("lambert f, channel 2", f[2], 1.0 / pi, 1e-6);
  diffuse.eval(brdf::Vec3f{0, 0, -1}, wo, f);
  expect("no light from below the horizon", f[0] == 0 && f[1] == 0 && f[2] == 0);

  // At normal incidence F = f0, G2 = 1 and D = 1 / (pi alpha^2), so f = f0 / (4 pi alpha^2).
  const brdf::Material glossy = brdf::Material::from_lobes(mirror_like(0.5, 0.04));
  std::array<float, 1> g{};
  glossy.eval(up, up, g);
  expect_near("ggx f at normal incidence", g[0], 0.04 / (4 * pi * 0.25), 1e-6);

  // Samples: the density that sampling used is the one that pdf() answers, and weights average to the albedo.
  std::array<float, 3> weight{};
  double mean = 0;
  const int n = 64;
  for (int i = 0; i < n * n; ++i) {
    const float v = (static_cast<float>(i / n) + 0.5f) / n, w = (static_cast<float>(i % n) + 0.5f) / n;
    const brdf::Sample s = diffuse.sample(wo, {0.5f, v, w}, weight);
    mean += weight[0];
    if (s.pdf > 0) expect_near("pdf of a sample over its density", diffuse.pdf(s.wi, wo) / s.pdf, 1, 1e-3);
    expect("a sample of a reflector is a reflection", s.pdf == 0 || s.flags == brdf::sample_reflection);
  }
  expect_near("mean sampling weight, which is the albedo", mean / (n * n), 0.5, 0.01);

  try {
    const std::array<std::byte, 4> garbage{};
    brdf::Material::decode(garbage);
    expect("garbage is refused", false);
  } catch (const brdf::Error& e) {
    expect("garbage is refused with a sentence", e.what()[0] != '\0');
  }
  std::printf("libbrdf %s, vectors for %s: %d failures\n", brdf::version(), brdf::simd_target(), failures);
  return failures ? 1 : 0;
}
