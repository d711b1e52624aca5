// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape/mesh.h"

#include <cstddef>
#include <span>

namespace brdf::render {

/// Reads a PLY file: ascii, binary_little_endian or binary_big_endian. Of "vertex" it takes x y z, nx ny nz and u v (also
/// named s t or texture_u texture_v), of "face" the list vertex_indices or vertex_index; polygons are cut into fans.
/// Other elements and properties are skipped.
/// Throws Error: not_recognized, malformed, truncated, no_data, limit_exceeded. `name` stands for the file. Thread-safe.
Mesh read_ply(std::span<const std::byte> bytes, const std::string& name, const MeshLimits& limits = {});

}  // namespace brdf::render
