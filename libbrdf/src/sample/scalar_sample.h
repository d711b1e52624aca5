// SPDX-License-Identifier: Apache-2.0
// One sample of the mixture, in plain C++.
#pragma once

#include "eval/tables.h"

#include <brdf/material.h>

namespace brdf::sample {

/// A direction of the mixture; z <= 0 where it fell below the horizon or wo is there.
Vec3f mixture_direction(const eval::Tables& t, const Vec3f& wo, const Vec3f& u) noexcept;

/// See Material::sample. pdf is what eval::pdf_scalar answers for the direction returned.
Sample sample_scalar(const eval::Tables& t, const Vec3f& wo, const Vec3f& u, std::span<float> weight) noexcept;

}  // namespace brdf::sample
