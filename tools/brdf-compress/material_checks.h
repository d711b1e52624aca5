// SPDX-License-Identifier: Apache-2.0
// What must hold of every `.brdfc` file, whatever it was made from.
#pragma once

#include "check.h"

#include <brdf/material.h>

#include <cstddef>
#include <span>
#include <string>

namespace brdf::cli {

/// Every cut at a refinement boundary decodes at every level and says how much of the file it is.
Check prefix_check(std::span<const std::byte> bytes, const std::string& path);

/// Finite, not negative, zero below the horizon, exchangeable where declared, the same by scalar and vector code;
/// over fixed pairs that include grazing, mirror, retro and near-normal ones. `material` stands at its level.
Checks value_checks(const Material& material);

/// Largest directional albedo. A measured material may exceed 1 by what its instrument added, so only what no
/// measurement explains fails.
Check albedo_check(const Material& material);

/// The largest directional albedo of any channel, for wo from the normal to 85 degrees in steps of 5.
struct AlbedoAt {
  double value = 0;
  int theta_o = 0;  ///< degrees
  bool finite = true;
};

AlbedoAt largest_albedo(const Material& material);

}  // namespace brdf::cli
