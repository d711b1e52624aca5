// SPDX-License-Identifier: Apache-2.0
// Directions of the sphere images and of the pairs.
#include "metrics/queries.h"

#include "metrics/half_vector_density.h"
#include "metrics/low_discrepancy.h"

namespace brdf::metrics {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double full_resolution = 64, full_lights = 600, full_candidates = 131072;
constexpr double disc_radius2 = 0.98;  // pixels nearer to the outline would see grazing directions only
constexpr double least_cosine = 1e-3;  // a light lower than this does not light the pixel

struct Frame {
  Vec3d t, b, n;
  Vec3d local(const Vec3d& w) const noexcept { return {glm::dot(w, t), glm::dot(w, b), glm::dot(w, n)}; }
};

int scaled(double full, double factor, int least) {
  return std::max(static_cast<int>(std::lround(full * factor)), least);
}

/// Frames of the pixels of an orthographic sphere: viewer at +z, y up, tangent along the parallels.
std::vector<Frame> sphere_frames(int resolution) {
  std::vector<Frame> frames;
  for (int row = 0; row < resolution; ++row) {
    for (int column = 0; column < resolution; ++column) {
      const double x = (column + 0.5) / resolution * 2 - 1, y = 1 - (row + 0.5) / resolution * 2;
      if (x * x + y * y >= disc_radius2) continue;
      const Vec3d n{x, y, std::sqrt(1 - x * x - y * y)};
      const Vec3d t = glm::normalize(glm::cross(Vec3d{0, 1, 0}, n));
      frames.push_back({t, glm::cross(n, t), n});
    }
  }
  return frames;
}

struct Environment {
  std::vector<Vec3d> direction, radiance;
};

/// Spherical Fibonacci directions under a blue sky with a warm and a cold lamp; radiance times solid angle.
Environment make_environment(int lights) {
  const Vec3d warm = glm::normalize(Vec3d{0.6, 0.5, 0.62}), cold = glm::normalize(Vec3d{-0.8, 0.3, 0.52});
  Environment env;
  for (int i = 0; i < lights; ++i) {
    const double k = i + 0.5, y = 1 - 2 * k / lights, phi = pi * (1 + std::sqrt(5.0)) * k;
    const double r = std::sqrt(1 - y * y);
    const Vec3d d{r * std::cos(phi), y, r * std::sin(phi)};
    Vec3d radiance = Vec3d(0.3) + 0.7 * std::max(y, 0.0) * Vec3d{0.6, 0.8, 1.0};
    if (glm::dot(d, warm) > 0.90) radiance += Vec3d{8, 7, 6};
    if (glm::dot(d, cold) > 0.96) radiance += Vec3d{5, 6, 8};
    env.direction.push_back(d);
    env.radiance.push_back(radiance * (4 * pi / lights));
  }
  return env;
}

void append_environment(QuerySet& set, const std::vector<Frame>& frames, int lights) {
  Environment env = make_environment(lights);
  for (std::size_t p = 0; p < frames.size(); ++p) {
    const Frame& f = frames[p];
    const Vec3f wo = rounded(f.local({0, 0, 1}));
    for (std::size_t l = 0; l < env.direction.size(); ++l) {
      if (glm::dot(f.n, env.direction[l]) <= least_cosine) continue;
      set.wi.push_back(rounded(f.local(env.direction[l])));
      set.wo.push_back(wo);
      set.pixel.push_back(static_cast<std::uint32_t>(p));
      set.light.push_back(static_cast<std::uint16_t>(l));
    }
  }
  set.radiance = std::move(env.radiance);
  set.image[0] = {0, set.wi.size(), static_cast<std::uint32_t>(frames.size())};
}

void append_light(QuerySet& set, std::size_t image, const std::vector<Frame>& frames, const Vec3d& towards) {
  const Vec3d light = glm::normalize(towards);
  ImageRows& rows = set.image[image];
  rows.first = set.wi.size();
  for (const Frame& f : frames) {
    if (glm::dot(f.n, light) <= least_cosine) continue;
    set.wi.push_back(rounded(f.local(light)));
    set.wo.push_back(rounded(f.local({0, 0, 1})));
    set.pixel.push_back(rows.pixels++);
  }
  rows.rows = set.wi.size() - rows.first;
}

Vec3d uniform_hemisphere(double u, double v) noexcept {
  const double r = std::sqrt(std::max(0.0, 1 - u * u)), phi = 2 * pi * v;
  return {r * std::cos(phi), r * std::sin(phi), u};
}

std::uint8_t band_of(double least_z) noexcept {
  std::uint8_t band = 0;
  while (band < last_headline_band + 1 && least_z <= std::cos(band_ends[band] * pi / 180)) ++band;
  return band;
}

}  // namespace

double QuerySet::gain(std::size_t row, int channel, int channels) const noexcept {
  const double cos_i = static_cast<double>(wi[row].z);
  if (row >= light.size()) return cos_i;
  const Vec3d& r = radiance[light[row]];
  return cos_i * (channels == 3 ? r[channel] : (r.x + r.y + r.z) / 3);
}

void append_pairs(QuerySet& set, double quality) {
  const auto candidates = static_cast<std::uint32_t>(scaled(full_candidates, quality, 256));
  const Sobol uniform(1), halves(5);  // two strategies with the same number of points, joined by the balance heuristic
  set.first_pair = set.wi.size();
  const auto add = [&](const Vec3d& wi, const Vec3d& wo) {
    const Vec3f i = rounded(wi), o = rounded(wo);
    if (!(i.z > 0 && o.z > 0)) return;
    set.wi.push_back(i);
    set.wo.push_back(o);
    set.pair_weight.push_back(1 / (1 / (2 * pi) + reflected_density(Vec3d(o), Vec3d(i))));
    set.pair_band.push_back(band_of(static_cast<double>(std::min(i.z, o.z))));
  };
  for (std::uint32_t k = 0; k < candidates; ++k) {
    const auto a = uniform(k), b = halves(k);
    add(uniform_hemisphere(a[0], a[1]), uniform_hemisphere(a[2], a[3]));
    const Vec3d wi = uniform_hemisphere(b[0], b[1]);
    add(wi, reflect_about(wi, half_vector(b[2], b[3])));
  }
  set.pairs = set.wi.size() - set.first_pair;
}

QuerySet build_queries(double quality) {
  QuerySet set;
  const int resolution = scaled(full_resolution, std::sqrt(std::sqrt(quality)), 8);
  const int lights = scaled(full_lights, std::sqrt(quality), 24);
  const std::vector<Frame> frames = sphere_frames(resolution);
  const std::size_t image_guess = frames.size() * static_cast<std::size_t>(lights) / 2 + 5 * frames.size();
  const std::size_t guess = image_guess + static_cast<std::size_t>(2.2 * full_candidates * quality) + 4096;
  for (auto* v : {&set.wi, &set.wo}) v->reserve(guess);
  set.pixel.reserve(image_guess);
  set.light.reserve(image_guess);
  append_environment(set, frames, lights);
  constexpr std::array<Vec3d, 4> towards{{{0, 0, 1}, {0.5, 0.5, 0.70710678118654752}, {1, 0.2, -0.4}, {-0.3, 1, 0.3}}};
  for (std::size_t k = 0; k < towards.size(); ++k) append_light(set, k + 1, frames, towards[k]);
  append_pairs(set, quality);
  append_albedo(set, quality);
  return set;
}

}  // namespace brdf::metrics
