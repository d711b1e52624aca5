// SPDX-License-Identifier: Apache-2.0
#include "profile/saturating.h"

#include <brdf/error.h>
#include <brdf/profile.h>

namespace brdf {

ProfileRecorder::ProfileRecorder(std::vector<std::string> slots) : slots_(std::move(slots)), materials_(slots_.size()) {}

void ProfileRecorder::record(std::size_t slot, ProfileOperation operation, const Vec3f& wi, const Vec3f& wo,
                             double contribution) noexcept {
  const ProfilePlace place = profile_place(wi, wo);
  count(slot, operation);
  if (place.transmission && operation != ProfileOperation::transmission) count(slot, ProfileOperation::transmission);
  add(slot, place, contribution);
}

void ProfileRecorder::first_hit(std::size_t slot, double pixels) noexcept {
  if (slot >= materials_.size()) return;
  constexpr double largest = 1e9;  // of one ray: more pixels than any image has
  profile::add_saturating(materials_[slot].footprint, profile::fixed_point(pixels, MaterialProfile::pixel_units, largest));
  profile::add_saturating(materials_[slot].first_hits, 1);
}

void ProfileRecorder::merge(const ProfileRecorder& other) {
  if (slots_ != other.slots_)
    throw Error(ErrorCode::invalid_argument, "recorders of different slots cannot be merged: one has " + std::to_string(slots_.size()) +
                                                 ", the other " + std::to_string(other.slots_.size()) + ", or their names differ");
  for (std::size_t i = 0; i < materials_.size(); ++i) materials_[i].merge(other.materials_[i]);
}

Profile ProfileRecorder::profile() const {
  Profile p;
  for (std::size_t i = 0; i < slots_.size(); ++i) p.materials[slots_[i]].merge(materials_[i]);
  return p;
}

}  // namespace brdf
