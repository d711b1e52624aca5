// SPDX-License-Identifier: Apache-2.0
/// @file direction.h
/// Directions and the spans in which batches of them travel.
///
/// Local frame: z is the surface normal, x the tangent. Every direction is a unit vector that points away from the
/// surface. `wi` points towards the light, `wo` towards the viewer.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace brdf {

using Vec3f = glm::vec3;
using Vec3d = glm::dvec3;

/// `size` unit vectors as three planes; any alignment.
struct DirectionSpan {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  std::size_t size = 0;
};

/// `size` writable unit vectors as three planes; any alignment.
struct MutableDirectionSpan {
  float* x = nullptr;
  float* y = nullptr;
  float* z = nullptr;
  std::size_t size = 0;
  operator DirectionSpan() const noexcept { return {x, y, z, size}; }
};

/// Values of a batch: plane c of `size` floats starts at `data + c * stride`; stride >= size.
struct PlanarSpan {
  float* data = nullptr;
  std::size_t stride = 0;
};

}  // namespace brdf
