// SPDX-License-Identifier: Apache-2.0
// What a Material of a formula shares.
#pragma once

#include "analytic/scatterer.h"
#include "eval/material_impl.h"

#include <brdf/analytic.h>
#include <brdf/material.h>

#include <memory>

namespace brdf::decode {

/// `model` has passed analytic::check. With `scatterer` null, one is made.
std::shared_ptr<Material::Impl> analytic_impl(MaterialInfo info, const AnalyticModel& model, EvalLevel level,
                                              std::shared_ptr<const analytic::Scatterer> scatterer = nullptr);

}  // namespace brdf::decode
