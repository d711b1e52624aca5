// SPDX-License-Identifier: Apache-2.0
// What an analytic model may say. Callers, files and the writer share these rules.
#pragma once

#include <brdf/analytic.h>

#include <optional>
#include <string>

namespace brdf::analytic {

inline constexpr float min_alpha = 1e-4f, max_alpha = 1;
inline constexpr float min_ior = 0.1f, max_ior = 10;

int channels_of(const AnalyticModel& model) noexcept;

/// f(wi, wo) = f(wo, wi). What transmits radiance has eta squared between the two.
bool is_reciprocal(const AnalyticModel& model) noexcept;

/// The first thing that is wrong, as a sentence with the field, the value found and the value allowed; nothing if all is
/// well.
std::optional<std::string> problem_of(const AnalyticModel& model);

/// Throws problem_of as Error(invalid_argument).
void check(const AnalyticModel& model);

}  // namespace brdf::analytic
