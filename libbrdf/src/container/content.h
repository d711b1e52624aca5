// SPDX-License-Identifier: Apache-2.0
// What a `.brdfc` file says, before it is bytes.
#pragma once

#include "container/chunk_types.h"
#include "residual/channel_transform.h"
#include "residual/residual_code.h"

#include <brdf/analytic.h>
#include <brdf/limits.h>
#include <brdf/lobes.h>
#include <brdf/material.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brdf::container {

/// One scattering component: which sides it joins and in which basis its residual is written.
struct Component {
  bool incident_below = false, outgoing_below = false;  ///< side pair; reflection above is false, false
  AxesKind axes = AxesKind::half_difference;
  bool mirror_symmetric = true;
  bool reciprocal = false;
  Channels channels;
  residual::ChannelTransform transform = residual::ChannelTransform::opponent;
};

/// What the flags of a component say of its residual.
inline residual::Azimuth azimuth_of(const Component& c) noexcept {
  if (!c.reciprocal) return residual::Azimuth::one_way;
  return c.mirror_symmetric ? residual::Azimuth::symmetric : residual::Azimuth::reciprocal;
}

/// The other way round; a component without a residual has all symmetries.
inline void set_symmetries(Component& c, const residual::ResidualCode& code) noexcept {
  c.reciprocal = code.empty() || residual::is_reciprocal(code.azimuth);
  c.mirror_symmetric = code.empty() || residual::is_mirror_symmetric(code.azimuth);
}

struct Content {
  Component component;
  LobeSet lobes;
  residual::ResidualCode residual;
  std::vector<RecordedError> errors;  ///< refinement 0 at `fast`; each further one at `balanced` and `exact`
  std::optional<Provenance> provenance;
  std::string fitter;
  std::optional<AnalyticModel> analytic;  ///< instead of lobes, residual and errors
  std::vector<std::byte> sampling;  ///< see density_codes.h; empty without
};

struct Unpacked {
  Content content;
  int refinements_read = 0, refinements_total = 0;
  std::uint64_t total_bytes = 0;
  std::uint64_t temporary_bytes = 0;  ///< that reading and adding up the layers take at most; see DecodeLimits
};

/// The bytes of a file. Deterministic. Throws Error(invalid_argument).
std::vector<std::byte> pack(const Content& content);

/// Sizes of a packed file: its length when cut after the lobes and after each refinement.
std::vector<std::uint64_t> boundaries(std::span<const std::byte> bytes, const DecodeLimits& limits);

/// Reads a file; with `allow_prefix` also one cut at a refinement boundary. Throws Error: not_recognized, malformed,
/// truncated, checksum, limit_exceeded, unsupported.
Unpacked unpack(std::span<const std::byte> bytes, const DecodeLimits& limits, bool allow_prefix);

}  // namespace brdf::container
