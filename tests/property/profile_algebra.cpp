// SPDX-License-Identifier: Apache-2.0
// Merging profiles is exact: commutative, associative, and the same for any split over recorders. Files give back what was written.
#include "support/random_profile.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace brdf {
namespace {

using test::random_direction;
using test::random_profile;

Profile sum(Profile a, const Profile& b) {
  a.merge(b);
  return a;
}

RC_GTEST_PROP(ProfileAlgebra, MergingIsCommutative, ()) {
  const Profile a = random_profile(), b = random_profile();
  RC_ASSERT(sum(a, b) == sum(b, a));
}

RC_GTEST_PROP(ProfileAlgebra, MergingIsAssociative, ()) {
  const Profile a = random_profile(), b = random_profile(), c = random_profile();
  RC_ASSERT(sum(sum(a, b), c) == sum(a, sum(b, c)));
}

RC_GTEST_PROP(ProfileAlgebra, AnEmptyProfileAddsNothing, ()) {
  const Profile a = random_profile();
  RC_ASSERT(sum(a, {}) == a);
  RC_ASSERT(sum({}, a) == a);
}

// Recorders of several threads give the bytes that one thread gives.
RC_GTEST_PROP(ProfileAlgebra, TheNumberOfRecordersHasNoEffect, ()) {
  const std::vector<std::string> slots = {"a", "b"};
  const int parts = *rc::gen::inRange(1, 5), queries = *rc::gen::inRange(0, 80);
  ProfileRecorder one(slots);
  std::vector<ProfileRecorder> many(static_cast<std::size_t>(parts), ProfileRecorder(slots));
  for (int i = 0; i < queries; ++i) {
    const Vec3f wi = random_direction(), wo = random_direction();
    const double c = *rc::gen::inRange(0, 1000) / 7.0;
    const auto slot = static_cast<std::size_t>(i % 2);
    one.record(slot, ProfileOperation::eval, wi, wo, c);
    many[*rc::gen::inRange<std::size_t>(0, many.size())].record(slot, ProfileOperation::eval, wi, wo, c);
  }
  for (std::size_t i = many.size() - 1; i > 0; --i) many[i - 1].merge(many[i]);
  RC_ASSERT(many[0].profile().write() == one.profile().write());
}

RC_GTEST_PROP(ProfileAlgebra, AFileGivesBackWhatWasWritten, ()) {
  const Profile p = random_profile();
  const std::vector<std::byte> bytes = p.write();
  const Profile back = Profile::read(bytes);
  RC_ASSERT(back == p);
  RC_ASSERT(back.write() == bytes);
}

// Every pair above the surface has a cell, whose edges hold its angles.
RC_GTEST_PROP(ProfileAlgebra, ACellHoldsTheAnglesOfItsPairs, ()) {
  Vec3f wi = random_direction(), wo = random_direction();
  wi.z = std::abs(wi.z);
  wo.z = std::abs(wo.z);
  RC_PRE(wi.z > 0 && wo.z > 0);
  const ProfilePlace p = profile_place(wi, wo);
  RC_ASSERT(p.cell < static_cast<std::uint32_t>(ProfileGrid::cells));
  const Vec3d a(wi), b(wo), s = a + b, d = a - b;
  const auto length = [](const Vec3d& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); };
  const double theta_h = std::atan2(std::hypot(s.x, s.y), s.z), theta_d = std::atan2(length(d), length(s));
  const int i = static_cast<int>(p.cell) / (ProfileGrid::theta_d * ProfileGrid::phi_d), j = static_cast<int>(p.cell) / ProfileGrid::phi_d % ProfileGrid::theta_d;
  constexpr double rounding = 2e-6;
  RC_ASSERT(theta_h >= ProfileGrid::theta_h_edge(i) - rounding);
  RC_ASSERT(theta_h <= ProfileGrid::theta_h_edge(i + 1) + rounding);
  RC_ASSERT(theta_d >= ProfileGrid::theta_d_edge(j) - rounding);
  RC_ASSERT(theta_d <= ProfileGrid::theta_d_edge(j + 1) + rounding);
}

}  // namespace
}  // namespace brdf
