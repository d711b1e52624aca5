// SPDX-License-Identifier: Apache-2.0
// How much of the light that it receives a material gives back, and how a file is kept from giving back more.
#pragma once

#include "encode/candidate.h"

#include <brdf/encode.h>
#include <brdf/material.h>
#include <brdf/measurement.h>

#include <functional>
#include <string>

namespace brdf::encode {

/// What a directional albedo may exceed max(1, that of the source) by: the quadrature's own error and rounding.
inline constexpr double energy_tolerance = 0.005;

/// What a file for one scene may reflect, over max(1, the source's largest albedo). A scale serves all directions, so a closer bound
/// on those that nobody looks from would darken the others.
inline constexpr double unasked_energy = 1.5;

/// The largest directional albedo of any channel at any level, for wo from the normal to 85 degrees.
struct LargestAlbedo {
  double value = 0;
  EvalLevel level = EvalLevel::fast;
  double theta_o = 0;  ///< degrees
};

LargestAlbedo largest_albedo(std::span<const std::byte> bytes);

/// The same of a measurement, cells that were not measured counting as black; by the samples of `material`.
double largest_albedo(const Measurement& m, const Material& material);

struct ClampedEnergy {
  double scale = 1;
  LargestAlbedo albedo;  ///< of the file as it is now
};

/// Scales everything that the file says down, in steps of 0.5 %, until no albedo exceeds `limit`, and packs it anew with
/// `repack`, which measures the errors again. Files of more than `most_bytes` are passed over.
ClampedEnergy clamp_energy(Encoded& e, double limit, std::uint64_t most_bytes, const std::function<void(Encoded&)>& repack);

/// One sentence.
std::string energy_sentence(EnergyMode mode, const LargestAlbedo& found, double source, double scale);

}  // namespace brdf::encode
