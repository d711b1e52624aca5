// SPDX-License-Identifier: Apache-2.0
#include "encode/energy.h"

#include "container/lobe_quantiser.h"
#include "sample/square_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace brdf::encode {
namespace {

constexpr std::array angles{0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 75.0, 80.0, 85.0};
constexpr int most_steps = 512;  // down to a sixteenth

Vec3f view(double degrees) {
  const double theta = degrees * std::numbers::pi / 180;
  return Vec3f(Vec3d(std::sin(theta), 0, std::cos(theta)));
}

/// Everything times 2^(-steps / 128): codes of amplitudes are whole steps. In slices f is proportional to the ndf.
void scale_down(container::Content& content, int steps) {
  const double scale = std::exp2(-steps / 128.0);
  for (Lobe& lobe : content.lobes.lobes) {
    if (container::has_microfacets(lobe.kind)) lobe.f90 *= scale;
    for (double& c : lobe.color) c *= scale;
  }
  const auto ndf_steps = static_cast<int>(std::ceil(steps / 128.0 * std::exp2(0.5 * content.residual.slices.ndf_step)));
  for (std::int16_t& code : content.residual.slices.ndf) code = static_cast<std::int16_t>(code - ndf_steps);
}

}  // namespace

LargestAlbedo largest_albedo(std::span<const std::byte> bytes) {
  LargestAlbedo largest;
  const Material whole = Material::decode(bytes);
  std::vector<float> a(static_cast<std::size_t>(whole.channels()));
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    const Material m = whole.prepare(level);
    for (const double degrees : angles) {
      m.albedo(view(degrees), a);
      const double most = static_cast<double>(*std::max_element(a.begin(), a.end()));
      if (most > largest.value) largest = {most, level, degrees};
    }
  }
  return largest;
}

double largest_albedo(const Measurement& m, const Material& material) {
  constexpr std::size_t rows = 32, samples = rows * rows;
  const MeasurementInterpolator reference(m);
  const auto channels = static_cast<std::size_t>(material.channels());
  std::vector<double> f(channels), sum(channels);
  std::vector<float> weight(channels);
  double largest = 0;
  for (const double degrees : angles) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t i = 0; i < samples; ++i) {
      const Sample s = material.sample(view(degrees), sample::lattice_point(i / rows, i % rows, rows), weight);
      if (!(s.pdf > 0) || !reference.eval(Vec3d(s.wi), Vec3d(view(degrees)), f)) continue;
      for (std::size_t c = 0; c < channels; ++c) sum[c] += f[c] * static_cast<double>(s.wi.z) / static_cast<double>(s.pdf);
    }
    largest = std::max(largest, *std::max_element(sum.begin(), sum.end()) / samples);
  }
  return largest;
}

ClampedEnergy clamp_energy(Encoded& e, double limit, std::uint64_t most_bytes, const std::function<void(Encoded&)>& repack) {
  const Encoded original = e;
  LargestAlbedo found = largest_albedo(e.bytes);
  int steps = 0;
  while (found.value > limit || e.bytes.size() > most_bytes) {
    if (steps >= most_steps) throw Error(ErrorCode::target_not_met, "compress: no scale keeps the albedo of this material below " + std::to_string(limit));
    // the albedo is nearly proportional: one long step, then short ones
    steps += std::max(1, static_cast<int>(std::floor(128 * std::log2(found.value / limit))));
    e = original;
    scale_down(e.content, steps);
    repack(e);
    found = largest_albedo(e.bytes);
  }
  return {std::exp2(-steps / 128.0), found};
}

std::string energy_sentence(EnergyMode mode, const LargestAlbedo& found, double source, double scale) {
  char text[200];
  std::snprintf(text, sizeof text, "energy: the largest albedo is %.4g, at %s and theta_o %.0f degrees; the measurement's is %.4g",
                found.value, to_string(found.level), found.theta_o, source);
  std::string sentence = text;
  if (found.value > std::max(1.0, source) + energy_tolerance) return sentence + ", and --energy clamp keeps it below max(1, that)";
  if (mode == EnergyMode::clamp && scale < 1) {
    std::snprintf(text, sizeof text, "; scaled by %.4f to stay below max(1, that)", scale);
    sentence += text;
  }
  return sentence;
}

}  // namespace brdf::encode
