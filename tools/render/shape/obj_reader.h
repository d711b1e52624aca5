// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shape/mesh.h"

#include <string_view>

namespace brdf::render {

/// Reads Wavefront OBJ text: v, vt, vn and f (polygons are cut into fans, indices may count backwards). Groups, materials,
/// lines and points are ignored. Normals are kept when every corner has one, texture coordinates likewise.
/// Throws Error: malformed (with the line), no_data, limit_exceeded. `name` stands for the file in sentences. Thread-safe.
Mesh read_obj(std::string_view text, const std::string& name, const MeshLimits& limits = {});

}  // namespace brdf::render
