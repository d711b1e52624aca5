// SPDX-License-Identifier: Apache-2.0
// Sampling tables from densities at their nodes, and back.
#pragma once

#include "sample/density.h"

#include <brdf/lobes.h>
#include <brdf/material.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace brdf::sample {

/// Densities at the nodes of each component (views, columns, edges; positive) and the share of the second at each view.
struct NodeDensities {
  std::vector<std::vector<double>> components;
  std::array<double, ComponentTable::views> second{};
};

NodeDensities node_densities(const Material::Sampling& tables);

/// The tables that such densities make, normalised. `lobes` are the material's own: two components where some are
/// retro-reflective, else one.
std::shared_ptr<const Material::Sampling> density_from_nodes(const LobeSet& lobes, const NodeDensities& nodes);

}  // namespace brdf::sample
