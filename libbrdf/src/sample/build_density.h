// SPDX-License-Identifier: Apache-2.0
// Tabulates the density of a material.
#pragma once

#include "eval/tables.h"
#include "sample/density.h"

#include <brdf/lobes.h>
#include <brdf/material.h>

#include <cstdint>
#include <memory>

namespace brdf::sample {

/// From f of `tables`; `lobes` are the material's own and say where it is peaked.
std::shared_ptr<const Material::Sampling> build_density(const LobeSet& lobes, const eval::Tables& tables, bool mirror_symmetric);

/// Most bytes that this takes beside what it returns, or that reading stored densities takes.
std::uint64_t build_density_temporary_bytes(int channels) noexcept;

}  // namespace brdf::sample
