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
  /// Bytes of the prefix that is asked for; 0 and more than the file has are all of it. Throws Error(invalid_argument) for one
  /// that ends at no boundary.
  std::uint64_t cut_at(std::uint64_t prefix_bytes) const;
  /// Refinements that a prefix of so many bytes holds whole.
  int refinements_in(std::uint64_t prefix_bytes) const noexcept;
};

using VersionHandle = std::shared_ptr<const MaterialVersion>;

/// Decodes, and evaluates at the balanced level, before anyone is served from it. Throws Error.
VersionHandle verify_version(std::string id, std::vector<std::byte> bytes);

}  // namespace brdf::service
