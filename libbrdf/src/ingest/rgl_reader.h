// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/ingest.h>

#include <cstddef>
#include <span>
#include <string>

namespace brdf::ingest {

struct RglMaterial {
  VisibleNormalTable table;
  std::string description;  ///< free text of the file, as printable UTF-8
};

/// Reads an isotropic RGB material of the RGL database (Dupuy and Jakob 2018). Values keep their sign. Throws Error:
/// unsupported (spectral, anisotropic, polarimetric), malformed, truncated, limit_exceeded; every sentence starts with
/// `name`.
RglMaterial read_rgl(std::span<const std::byte> bytes, const std::string& name, const IngestOptions& options);

}  // namespace brdf::ingest
