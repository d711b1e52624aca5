// SPDX-License-Identifier: Apache-2.0
// Meshes that are made and not read, so that scenes stay small. Every one has normals and texture coordinates, is the same
// on every machine, and faces outwards or up (+y).
#pragma once

#include "shape/mesh.h"

#include <cstdint>
#include <vector>

namespace brdf::render {

/// Parallelogram of 2 triangles: corner, corner + edge_u, ... Its normal is along edge_u x edge_v.
Mesh make_quad(const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v);

/// Box around the origin, edges 2 long, 12 triangles with flat normals.
Mesh make_box();

/// Surface of revolution about +y of a profile of (radius, height) points from bottom to top: cups, stands, rings. A corner of the profile
/// of more than 30 degrees stays sharp. `segments` >= 3.
Mesh make_lathe(const std::vector<glm::vec2>& profile, int segments);

struct NoiseOptions {
  float amplitude = 0;    ///< largest displacement, in units of the shape
  float frequency = 4;    ///< lattice cells per unit
  int octaves = 1;        ///< each of twice the frequency and half the amplitude, 1 to 8
  std::uint32_t seed = 1;
};

/// Sphere of radius 1 whose surface is moved along its normal; 2 * segments * (segments - 1) * 2 triangles or so.
Mesh make_blob(int segments, const NoiseOptions& noise);

/// Square of side 2 in the plane y = 0 with `segments` squared squares, two triangles each, moved along +y.
Mesh make_terrain(int segments, const NoiseOptions& noise);

}  // namespace brdf::render
