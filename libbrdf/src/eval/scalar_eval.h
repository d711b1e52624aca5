// SPDX-License-Identifier: Apache-2.0
// Float evaluation of one pair in plain C++: any number of channels, any processor, the same bits everywhere.
#pragma once

#include "eval/pair_terms.h"
#include "eval/tables.h"

#include <span>

namespace brdf::eval {

/// f of lobes and grid into `f`, channels values.
void eval_scalar(const LobeParams& lobes, const GridParams& grid, const Vec3f& wi, const Vec3f& wo,
                 std::span<float> f) noexcept;

}  // namespace brdf::eval
