// SPDX-License-Identifier: Apache-2.0
// Batches of samples and densities; the instruction set is chosen at run time. Without tables both are of the cosine.
#pragma once

#include "eval/tables.h"

#include <brdf/direction.h>
#include <brdf/material.h>

namespace brdf::sample {

/// See Material::pdf.
void pdf_batch(const Material::Sampling* s, DirectionSpan wi, DirectionSpan wo, float* pdf) noexcept;

/// Directions and their densities, without weights.
void draw_batch(const Material::Sampling* s, DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf) noexcept;

/// See Material::sample. Rows of views that are not above the horizon are all zero.
void sample_batch(const eval::Tables& t, const Material::Sampling* s, DirectionSpan wo, DirectionSpan u,
                  MutableDirectionSpan wi, float* pdf, PlanarSpan weight) noexcept;

}  // namespace brdf::sample
