// SPDX-License-Identifier: Apache-2.0
#include "support/expect_error.h"

#include <brdf/profile.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace brdf {
namespace {

constexpr float degrees = std::numbers::pi_v<float> / 180;
Vec3f at(float theta, float phi) {
  return {std::sin(theta * degrees) * std::cos(phi * degrees), std::sin(theta * degrees) * std::sin(phi * degrees), std::cos(theta * degrees)};
}

TEST(ProfileRecorder, CountsWhatIsAskedOfEachSlot) {
  ProfileRecorder r({"floor", "ball"});
  r.record(0, ProfileOperation::eval, at(30, 0), at(62, 180), 0.5);
  r.record(0, ProfileOperation::eval, at(40, 0), at(10, 180), 0.25);
  r.count(0, ProfileOperation::pdf, 7);
  r.record(1, ProfileOperation::sample, at(0, 0), at(0, 0), 2);
  const Profile p = r.profile();
  const MaterialProfile& floor = p.at("floor");
  EXPECT_EQ(floor.operations, (std::array<std::uint64_t, 4>{2, 0, 7, 0}));
  EXPECT_DOUBLE_EQ(floor.contribution(), 0.75);
  EXPECT_EQ(floor.contributions, 2U);
  EXPECT_NEAR(floor.range_i.least, 30 * degrees, 1e-4);
  EXPECT_NEAR(floor.range_i.most, 40 * degrees, 1e-4);
  EXPECT_NEAR(floor.range_o.least, 10 * degrees, 1e-4);
  EXPECT_NEAR(floor.range_o.most, 62 * degrees, 1e-4);
  EXPECT_EQ(floor.theta_o[12], static_cast<std::uint64_t>(0.5 * MaterialProfile::units));
  EXPECT_TRUE(p.at("ball").asked(ProfileOperation::sample));
  EXPECT_FALSE(floor.asked(ProfileOperation::sample));
  EXPECT_DOUBLE_EQ(p.share("ball"), 2 / 2.75);
  EXPECT_EQ(p.share("nobody"), 0);
  test::expect_error(ErrorCode::invalid_argument, {"'nobody'", "ball, floor"}, [&] { p.at("nobody"); });
}

TEST(ProfileRecorder, KeepsTheFootprint) {
  ProfileRecorder r({"far"});
  for (int i = 0; i < 3 * 64; ++i) r.first_hit(0, 1.0 / 64);
  EXPECT_DOUBLE_EQ(r.profile().at("far").footprint_pixels(), 3);
  EXPECT_EQ(r.profile().at("far").first_hits, 192U);
}

TEST(ProfileRecorder, IgnoresWhatIsNoContribution) {
  ProfileRecorder r({"a"});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const double c : {0.0, -1.0, static_cast<double>(nan), 1e-12}) r.record(0, ProfileOperation::eval, at(10, 0), at(10, 0), c);
  r.record(0, ProfileOperation::eval, {nan, 0, 1}, at(10, 0), 1);
  r.record(0, ProfileOperation::eval, {0, 0, std::numeric_limits<float>::infinity()}, at(10, 0), 1);
  r.record(0, ProfileOperation::eval, at(170, 0), at(170, 0), 1);  // both below
  r.record(5, ProfileOperation::eval, at(10, 0), at(10, 0), 1);    // no such slot
  r.first_hit(5, 1);
  const MaterialProfile m = r.profile().at("a");
  EXPECT_EQ(m.contributions, 0U);
  EXPECT_EQ(m.contribution(), 0);
  EXPECT_GT(m.range_i.least, m.range_i.most);
}

TEST(ProfileRecorder, TransmissionHasNoCell) {
  ProfileRecorder r({"glass"});
  r.record(0, ProfileOperation::sample, at(150, 0), at(30, 0), 1.5);
  const Profile p = r.profile();
  EXPECT_TRUE(p.at("glass").asked(ProfileOperation::transmission));
  EXPECT_EQ(p.at("glass").contribution(), 0);
  EXPECT_EQ(p.at("glass").transmitted, static_cast<std::uint64_t>(1.5 * MaterialProfile::units));
  EXPECT_EQ(p.share("glass"), 1);
}

TEST(ProfileRecorder, SumsStopAtTheLargestNumber) {
  MaterialProfile m;
  const ProfilePlace place = profile_place(at(10, 0), at(20, 0));
  m.add(place, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(m.contribution(), MaterialProfile::largest_contribution);
  for (int i = 0; i < 20; ++i) {
    const MaterialProfile twin = m;
    m.merge(twin);
  }
  EXPECT_EQ(m.histogram[place.cell], std::numeric_limits<std::uint64_t>::max());
}

TEST(ProfileRecorder, NarrowLobesHaveBinsOfTheirOwn) {
  // the half vectors of 0.02 and 0.1 degrees
  EXPECT_NE(profile_place(at(30, 0), at(30.04F, 180)).cell, profile_place(at(30, 0), at(30.2F, 180)).cell);
  EXPECT_LT(ProfileGrid::theta_h_edge(1), 0.04 * degrees);
  EXPECT_NEAR(ProfileGrid::theta_h_edge(ProfileGrid::theta_h), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(ProfileGrid::theta_d_edge(ProfileGrid::theta_d), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(ProfileGrid::phi_d_edge(ProfileGrid::phi_d), std::numbers::pi, 1e-12);
  EXPECT_NEAR(ProfileGrid::phi_d_edge(ProfileGrid::phi_d / 2), std::numbers::pi / 2, 1e-12);
}

TEST(ProfileRecorder, SixteenthsOfTheCircleFollowTheHalfVector) {
  for (int i = 0; i < 16; ++i)
    for (const float within : {0.5F, 11.0F, 22.0F}) {
      const float phi = 22.5F * static_cast<float>(i) + within;
      EXPECT_EQ(profile_place(at(30, phi), at(30, phi)).phi_h, i) << phi;
      EXPECT_NEAR(profile_place(at(phi / 4, 0), at(30, 0)).theta_i, phi / 4 * degrees, 1e-4);
    }
}

TEST(ProfileRecorder, SlotsOfOtherNamesDoNotMerge) {
  ProfileRecorder a({"x"}), b({"y"});
  test::expect_error(ErrorCode::invalid_argument, {"different slots"}, [&] { a.merge(b); });
}

}  // namespace
}  // namespace brdf
