// SPDX-License-Identifier: Apache-2.0
// What a Material handle shares.
#pragma once

#include "eval/tables.h"
#include "residual/residual_grid.h"

#include <brdf/material.h>

#include <memory>

namespace brdf {

/// Built by eval::make_impl and not changed once a handle holds it; `tables` points into `grid`, so it is neither copied
/// nor moved.
struct Material::Impl {
  MaterialInfo info;
  LobeSet lobes;
  residual::ResidualGrid grid;
  EvalLevel level = EvalLevel::fast;
  eval::Tables tables;
  std::shared_ptr<const void> source;  ///< the decoder's coefficients, from which prepare() builds other levels

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

namespace eval {

/// Validates and precomputes. Throws Error(invalid_argument) or Error(limit_exceeded). `source` is left empty for the
/// caller to set before the result becomes const.
std::shared_ptr<Material::Impl> make_impl(MaterialInfo info, LobeSet lobes, residual::ResidualGrid grid, EvalLevel level);

}  // namespace eval
}  // namespace brdf
