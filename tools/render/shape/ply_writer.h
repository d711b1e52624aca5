// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape/mesh.h"

#include <cstddef>
#include <vector>

namespace brdf::render {

/// The mesh as a binary little-endian PLY file that read_ply reads back bit for bit: x y z, nx ny nz where it has normals, u v
/// where it has texture coordinates, and triangles. Thread-safe.
std::vector<std::byte> write_ply(const Mesh& mesh);

}  // namespace brdf::render
