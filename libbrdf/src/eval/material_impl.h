// SPDX-License-Identifier: Apache-2.0
// What a Material handle shares.
#pragma once

#include "analytic/scatterer.h"
#include "eval/tables.h"
#include "residual/residual_grid.h"

#include <brdf/material.h>

#include <memory>
#include <optional>
#include <utility>

namespace brdf {

namespace eval {

/// What a material has beside its lobes: at most one of them.
struct Residual {
  Residual() = default;
  Residual(residual::ResidualGrid table) : grid(std::move(table)) {}
  Residual(slices::SliceTable table) : slices(std::move(table)) {}
  residual::ResidualGrid grid;               ///< over the lobes
  std::optional<slices::SliceTable> slices;  ///< f itself, lobes included
};

}  // namespace eval

/// Built by eval::make_impl and not changed once a handle holds it; `tables` points into `residual`, so it is neither copied
/// nor moved.
struct Material::Impl {
  MaterialInfo info;
  LobeSet lobes;
  eval::Residual residual;
  EvalLevel level = EvalLevel::fast;
  eval::Tables tables;
  std::shared_ptr<const void> source;  ///< the decoder's coefficients, from which prepare() builds other levels
  std::optional<AnalyticModel> model;
  std::shared_ptr<const analytic::Scatterer> scatterer;  ///< who samples a model; null: the tables, or the cosine
  const analytic::GgxScatter* facets = nullptr;          ///< of `scatterer`; who evaluates a model, null: the tables

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

namespace eval {

/// Validates and precomputes. Throws Error(invalid_argument) or Error(limit_exceeded). `source` is left empty for the
/// caller to set before the result becomes const.
std::shared_ptr<Material::Impl> make_impl(MaterialInfo info, LobeSet lobes, Residual residual, EvalLevel level);

}  // namespace eval
}  // namespace brdf
