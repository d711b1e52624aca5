// SPDX-License-Identifier: Apache-2.0
// Quantised coefficients as refinements, coarse to fine.
#pragma once

#include "encode/quantiser.h"
#include "residual/residual_code.h"

namespace brdf::encode {

/// Splits by frequency into at most `count` layers of about doubling size; nothing but zeros gives none.
residual::ResidualCode make_layers(const Quantised& quantised, const residual::ResidualCode& empty, int step_code, int count);

/// How many refinements a file of so many bytes should have: each costs about twelve bytes.
int layer_count(std::uint64_t file_bytes) noexcept;

}  // namespace brdf::encode
