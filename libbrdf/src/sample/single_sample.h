// SPDX-License-Identifier: Apache-2.0
// One sample and one density; the instruction set is chosen at run time.
#pragma once

#include "sample/density.h"

#include <brdf/direction.h>

namespace brdf::sample {

/// A direction for Material::sample and its density; both 0 for a view that is not above the horizon.
float draw_single(const Material::Sampling* s, const Vec3f& wo, const Vec3f& u, Vec3f& wi) noexcept;

/// See Material::pdf.
float pdf_single(const Material::Sampling* s, const Vec3f& wi, const Vec3f& wo) noexcept;

}  // namespace brdf::sample
