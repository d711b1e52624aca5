// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/ingest.h>

#include <cstddef>
#include <span>
#include <string>

namespace brdf::ingest {

/// Reads a MERL table. A cell with a channel that is negative or not finite is invalid. Values become float, as the
/// measurement keeps them. Provenance is left to the caller. Throws Error: malformed, truncated, limit_exceeded,
/// no_data; every sentence starts with `name`.
HalfDifferenceTable read_merl(std::span<const std::byte> bytes, const std::string& name, const IngestOptions& options);

}  // namespace brdf::ingest
