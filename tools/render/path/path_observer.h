// SPDX-License-Identifier: Apache-2.0
// What a renderer tells while it renders: every question to a material, and every ray.
#pragma once

#include "scene/geometry_store.h"

#include <brdf/direction.h>

#include <cstdint>

namespace brdf::render {

/// Bits of MaterialQuery::operations.
enum QueryOperations : std::uint32_t { query_eval = 1, query_pdf = 2, query_sample = 4 };

/// One pair of directions that a path asked a material about. It is reported when the path is complete, for only then its
/// contribution is known.
struct MaterialQuery {
  std::uint32_t slot = 0;        ///< of the scene's materials
  std::uint32_t operations = 0;  ///< what was called for this pair
  std::uint32_t flags = 0;       ///< SampleFlags of what scatters from wo to wi
  Vec3f wi{0}, wo{0};            ///< local, away from the surface
  float contribution = 0;        ///< luminance that reaches the camera through this pair, as it is added to the pixel's sum
  float pixels = 0;              ///< 1 where the camera, or a delta lobe that it looks through, sees this vertex first
};

/// One per thread: its members are called by that thread alone, in the order of the path.
class PathObserver {
 public:
  virtual ~PathObserver() = default;
  virtual void query(const MaterialQuery&) noexcept {}
  /// `distance`: to what the shadow ray asks about; infinite for others.
  virtual void ray(const Ray&, float distance, bool is_shadow) noexcept { static_cast<void>(distance), static_cast<void>(is_shadow); }
};

}  // namespace brdf::render
