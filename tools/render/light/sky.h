// SPDX-License-Identifier: Apache-2.0
// Environments of the project's own making, described by a few numbers.
#pragma once

#include "image/image.h"

#include <vector>

namespace brdf::render {

/// A lamp with a soft edge, far away.
struct SkyLamp {
  Vec3f direction{0, 1, 0};      ///< towards it; need not have length 1
  float width = 20, height = 20; ///< degrees, full angles; a disc where round
  bool round = false;
  Vec3f radiance{10};
};

struct SkyDescription {
  Vec3f zenith{0.3f, 0.45f, 0.7f}, horizon{0.8f}, ground{0.2f};
  std::vector<SkyLamp> lamps;
  int width = 1024;              ///< of the picture; it is half as high
};

/// Latitude-longitude picture of it. From the horizon up radiance goes to that of the zenith with the root of the sine of the
/// elevation; below the horizon it is that of the ground.
Image make_sky(const SkyDescription& sky);

}  // namespace brdf::render
