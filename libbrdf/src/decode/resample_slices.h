// SPDX-License-Identifier: Apache-2.0
// The table that evaluation reads, from a residual in slice coordinates.
#pragma once

#include "residual/reconstruct.h"
#include "residual/residual_grid.h"

#include <brdf/lobes.h>

namespace brdf::decode {

/// Measurement over lobes at the nodes of a half/difference grid. Nodes below the horizon continue the line
/// through the last two above it with the same theta_h and phi_d.
residual::ResidualGrid resample_slices(const residual::Coefficients& c, const LobeSet& lobes, const residual::GridSize& size);

/// Bytes that this takes at most beside its result.
std::size_t resample_temporary_bytes(const residual::SliceFrame& frame, int channels, const residual::GridSize& size) noexcept;

}  // namespace brdf::decode
