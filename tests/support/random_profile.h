// SPDX-License-Identifier: Apache-2.0
// Profiles as a renderer might record them, from RapidCheck.
#pragma once

#include <brdf/profile.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <vector>

namespace brdf::test {

/// Any direction, below the horizon now and then; poles and the horizon itself more often than by chance.
inline Vec3f random_direction() {
  const int z = *rc::gen::inRange(-300, 1001), turn = *rc::gen::inRange(0, 360);
  const float c = static_cast<float>(z) / 1000, s = std::sqrt(1 - c * c);
  const float phi = static_cast<float>(turn) * 0.0174532925F;
  return {s * std::cos(phi), s * std::sin(phi), c};
}

inline Profile random_profile() {
  const std::vector<std::string> names = {"wall", "ball", "a name with spaces", "\xC3\xA4"};
  const auto first = *rc::gen::inRange<std::size_t>(0, names.size()), count = *rc::gen::inRange<std::size_t>(0, names.size() - first + 1);
  ProfileRecorder recorder(std::vector<std::string>(names.begin() + static_cast<std::ptrdiff_t>(first), names.begin() + static_cast<std::ptrdiff_t>(first + count)));
  const int queries = *rc::gen::inRange(0, 60);
  for (int i = 0; i < queries && count > 0; ++i) {
    const auto slot = *rc::gen::inRange<std::size_t>(0, count);
    const auto operation = static_cast<ProfileOperation>(*rc::gen::inRange(0, profile_operations));
    // from nothing over ordinary values to those that are cut off
    const double contribution = std::ldexp(1.0, *rc::gen::inRange(-40, 40)) * *rc::gen::inRange(0, 3);
    recorder.record(slot, operation, random_direction(), random_direction(), contribution);
    if (*rc::gen::inRange(0, 3) == 0) recorder.first_hit(slot, 1.0 / *rc::gen::inRange(1, 4096));
  }
  return recorder.profile();
}

}  // namespace brdf::test
