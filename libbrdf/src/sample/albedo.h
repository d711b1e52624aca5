// SPDX-License-Identifier: Apache-2.0
// Directional albedo.
#pragma once

#include "analytic/scatterer.h"
#include "eval/tables.h"

#include <brdf/direction.h>
#include <brdf/material.h>

#include <span>

namespace brdf::sample {

/// Integral of f cos_i over wi. See Material::albedo.
void albedo(const eval::Tables& t, const Material::Sampling* s, const Vec3f& wo, std::span<float> a) noexcept;

/// The same of an analytic material: the closed form where its lobes are delta ones.
void albedo(const analytic::Scatterer& s, const Vec3f& wo, std::span<float> a) noexcept;

}  // namespace brdf::sample
