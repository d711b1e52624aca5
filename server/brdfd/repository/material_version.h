// SPDX-License-Identifier: Apache-2.0
// One content of one material, as it was verified.
#pragma once

#include "query/descriptor.h"

#include <brdf/material.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace brdf::service {

/// Immutable. Calls in flight hold the version that they began with, whatever becomes of the file. The compressed bytes
/// stay in memory, some kilobytes: a file that is replaced by a broken one can then go on serving.
struct MaterialVersion {
  std::string id, version;
  std::vector<std::byte> bytes;
  MaterialInfo info;
  std::vector<std::uint64_t> boundaries;  ///< after the lobes and after each refinement
  Descriptor descriptor;

  /// Recorded error of the prefix of `refinements` at `level`; null where the file has none.
  const RecordedError* error(int refinements, EvalLevel level) const noexcept;
  /// Refinements within the first `prefix_bytes` (0: all). Throws Error(invalid_argument) where they end at no boundary.
  int refinements_of(std::uint64_t prefix_bytes) const;
};

using VersionHandle = std::shared_ptr<const MaterialVersion>;

/// Decodes, and evaluates at the balanced level, before anyone is served from it. Throws Error.
VersionHandle verify_version(std::string id, std::vector<std::byte> bytes);

}  // namespace brdf::service
