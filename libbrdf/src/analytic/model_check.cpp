// SPDX-License-Identifier: Apache-2.0
#include "analytic/model_check.h"

#include <brdf/error.h>
#include <brdf/limits.h>

#include <algorithm>
#include <cstdio>
#include <span>

namespace brdf {
namespace analytic {
namespace {

using Problem = std::optional<std::string>;

std::string shown(float v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(v));
  return text;
}

/// `value` in [low, high]; NaN is not.
Problem in_range(const std::string& field, float value, float low, float high) {
  if (value >= low && value <= high) return std::nullopt;
  return field + " is " + shown(value) + ", allowed is " + shown(low) + " to " + shown(high) + ".";
}

Problem in_range(const std::string& field, int value, int low, int high) {
  if (value >= low && value <= high) return std::nullopt;
  return field + " is " + std::to_string(value) + ", allowed is " + std::to_string(low) + " to " + std::to_string(high) + ".";
}

constexpr int most_channels = static_cast<int>(DecodeLimits{}.max_channels);

Problem reflectances(const std::string& field, std::span<const float> values) {
  const std::size_t too_many = static_cast<std::size_t>(most_channels) + 1;
  if (auto p = in_range(field + ": the number of channels", static_cast<int>(std::min(values.size(), too_many)), 1, most_channels))
    return p;
  for (std::size_t c = 0; c < values.size(); ++c)
    if (auto p = in_range(field + " of channel " + std::to_string(c), values[c], 0.0f, 1.0f)) return p;
  return std::nullopt;
}

struct Check {
  Problem operator()(const Lambert& m) const { return reflectances("Lambert: albedo", m.albedo); }
  Problem operator()(const Mirror& m) const { return reflectances("Mirror: reflectance", m.reflectance); }
  Problem operator()(const Dielectric& m) const {
    if (auto p = in_range("Dielectric: ior", m.ior, min_ior, max_ior)) return p;
    return in_range("Dielectric: the number of channels", m.channels, 1, most_channels);
  }
  Problem operator()(const GgxReflector& m) const {
    if (auto p = in_range("GGX: alpha_x", m.alpha_x, min_alpha, max_alpha)) return p;
    if (auto p = in_range("GGX: alpha_y", m.alpha_y, min_alpha, max_alpha)) return p;
    if (m.multiple_scattering && m.alpha_x != m.alpha_y)
      return "GGX: multiple scattering is asked for with alpha_x " + shown(m.alpha_x) + " and alpha_y " + shown(m.alpha_y) +
             ", allowed are equal ones.";
    return reflectances("GGX: f0", m.f0);
  }
};

struct CountChannels {
  int operator()(const Lambert& m) const noexcept { return static_cast<int>(m.albedo.size()); }
  int operator()(const GgxReflector& m) const noexcept { return static_cast<int>(m.f0.size()); }
  int operator()(const Mirror& m) const noexcept { return static_cast<int>(m.reflectance.size()); }
  int operator()(const Dielectric& m) const noexcept { return m.channels; }
};

}  // namespace

int channels_of(const AnalyticModel& model) noexcept { return std::visit(CountChannels{}, model); }

bool is_reciprocal(const AnalyticModel& model) noexcept { return !std::holds_alternative<Dielectric>(model); }

std::optional<std::string> problem_of(const AnalyticModel& model) { return std::visit(Check{}, model); }

void check(const AnalyticModel& model) {
  if (const auto problem = problem_of(model)) throw Error(ErrorCode::invalid_argument, *problem);
}

}  // namespace analytic

const char* name_of(const AnalyticModel& model) noexcept {
  constexpr const char* names[] = {"lambert", "ggx", "mirror", "dielectric"};
  return names[model.index()];
}

}  // namespace brdf
