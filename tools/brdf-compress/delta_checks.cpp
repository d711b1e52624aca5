// SPDX-License-Identifier: Apache-2.0
#include "delta_checks.h"

#include "counter_random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::cli {
namespace {

constexpr std::array thetas{0.0, 30.0, 60.0, 80.0, 89.0, 89.9};  ///< degrees
constexpr std::uint64_t samples = 100000;

/// Worst figures over all views.
struct Worst {
  double direction = 0;  ///< distance from where Snell's law or the mirror puts it
  double choice = 0;     ///< share of reflections against its pdf, in standard errors
  double energy = 0;     ///< mean weight of importance against the albedo, in standard errors
  double radiance = 0;   ///< weight of radiance times eta squared against that of importance, relative
  double density = 0;    ///< largest of eval and pdf, which are 0
  bool probabilities = true;
};

double off_the_law(const Sample& s, const Vec3f& wo) {
  const double eta = static_cast<double>(s.eta), flip = (s.flags & sample_transmission) != 0 ? -1 : 1;
  const Vec3d i(s.wi), o(wo);
  const double x = i.x * eta + o.x, y = i.y * eta + o.y, length = std::sqrt(i.x * i.x + i.y * i.y + i.z * i.z);
  return std::max({std::abs(x), std::abs(y), std::abs(length - 1), i.z * o.z * flip > 0 ? 0.0 : 1.0});
}

void look(const Material& m, const Vec3f& wo, std::uint64_t seed, Worst& worst) {
  const auto channels = static_cast<std::size_t>(m.channels());
  std::vector<float> weight(channels), radiance(channels), a(channels), f(channels);
  const CounterRandom random(seed);
  double reflected = 0, probability = 0, mean = 0, square = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Vec3f u{random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2)};
    const Sample s = m.sample(wo, u, weight, TransportMode::importance), again = m.sample(wo, u, radiance);
    const double eta2 = static_cast<double>(s.eta) * static_cast<double>(s.eta);
    if (!(s.pdf > 0 && s.pdf <= 1) || (s.flags & sample_delta) == 0 || again.flags != s.flags) worst.probabilities = false;
    if ((s.flags & sample_reflection) != 0) reflected += 1, probability = static_cast<double>(s.pdf);
    worst.direction = std::max(worst.direction, off_the_law(s, wo));
    double sum = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      sum += static_cast<double>(weight[c]) / static_cast<double>(channels);
      worst.radiance = std::max(worst.radiance, std::abs(static_cast<double>(radiance[c]) * eta2 - static_cast<double>(weight[c])));
    }
    mean += sum / samples;
    square += sum * sum / samples;
    worst.density = std::max(worst.density, static_cast<double>(m.eval_pdf(s.wi, wo, f)));
    for (const float v : f) worst.density = std::max(worst.density, static_cast<double>(v));
  }
  const double count = static_cast<double>(samples), share = reflected / count;
  const double noise = std::sqrt(std::max(probability * (1 - probability), 1 / count) / count);
  worst.choice = std::max(worst.choice, std::abs(share - probability) / noise);
  m.albedo(wo, a);
  double albedo = 0;
  for (const float v : a) albedo += static_cast<double>(v) / static_cast<double>(channels);
  const double error = std::max(std::sqrt(std::max(square - mean * mean, 0.0) / count), 1e-6);
  worst.energy = std::max(worst.energy, std::abs(mean - albedo) / error);
}

}  // namespace

Checks delta_checks(const Material& material) {
  Worst worst;
  const bool both_sides = (material.scatter_flags() & sample_transmission) != 0;
  std::uint64_t seed = 0;
  for (const double degrees : thetas)
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && !both_sides) continue;
      const double theta = degrees * std::numbers::pi / 180;
      look(material, Vec3f(Vec3d(std::sin(theta) * 0.6, std::sin(theta) * 0.8, side * std::cos(theta))), ++seed, worst);
    }
  const std::string where = std::string("at ") + to_string(material.level()) + (both_sides ? ", from both sides" : "");
  return {{"delta samples are flagged and have a probability", worst.probabilities, worst.probabilities ? 0.0 : 1.0, "all of them", where},
          {"directions obey reflection and refraction", worst.direction <= 1e-5, worst.direction, "at most 1e-5", where},
          {"reflection is chosen as often as its pdf says", worst.choice <= 5, worst.choice, "5 standard errors", where},
          {"mean weight is the albedo", worst.energy <= 5, worst.energy, "5 standard errors", where},
          {"radiance is scaled by eta squared", worst.radiance <= 1e-5, worst.radiance, "at most 1e-5", where},
          {"eval and pdf are 0", worst.density == 0, worst.density, "0", where}};
}

}  // namespace brdf::cli
