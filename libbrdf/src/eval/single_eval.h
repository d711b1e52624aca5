// SPDX-License-Identifier: Apache-2.0
// f of one pair; the instruction set is chosen at run time.
#pragma once

#include "eval/tables.h"

#include <brdf/direction.h>

#include <span>

namespace brdf::eval {

/// f of the whole material into `f`, channels values.
void eval_single(const Tables& t, const Vec3f& wi, const Vec3f& wo, std::span<float> f) noexcept;

}  // namespace brdf::eval
