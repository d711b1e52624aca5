// SPDX-License-Identifier: Apache-2.0
// What a scene asks of its materials, recorded while it is rendered.
#pragma once

#include "path/path_observer.h"
#include "path/render_scene.h"

#include <brdf/profile.h>

#include <memory>
#include <vector>

namespace brdf::render {

/// Recorders of a rendering, one per thread. A contribution of 1 is a pixel of radiance 1.
class ProfileObservers {
 public:
  /// For render_scene with these options.
  ProfileObservers(const Scene& scene, const RenderOptions& options);
  ~ProfileObservers();
  ProfileObservers(const ProfileObservers&) = delete;
  ProfileObservers& operator=(const ProfileObservers&) = delete;

  /// What render_scene takes.
  std::span<PathObserver* const> observers() const noexcept { return pointers_; }
  /// Of all threads, once rendering is over; of the slots that a shape has.
  Profile profile() const;

 private:
  class Recorder;
  std::vector<std::unique_ptr<Recorder>> recorders_;
  std::vector<PathObserver*> pointers_;
};

}  // namespace brdf::render
