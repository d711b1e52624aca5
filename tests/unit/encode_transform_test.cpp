// SPDX-License-Identifier: Apache-2.0
// The transform across channels follows the material.
#include "encode/transform_choice.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brdf {
namespace {

using residual::ChannelTransform;

const LobeSet grey{3, {{LobeKind::lambert, 1, 1, {0.9, 0.9, 0.9}}}};

TEST(ChannelTransform, DecorrelatesWhatGoesTogether) {
  const Measurement m = test::small_measurement({24, 12, 16}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    for (double& v : f) v = 0.9 / 3.14159265 * std::exp(0.8 * std::sin(7 * wi.z * wo.z));
  });
  EXPECT_EQ(encode::decorrelating_transform(m, grey, 1e-3), ChannelTransform::opponent);
}

TEST(ChannelTransform, LeavesIndependentChannelsAlone) {
  // one busy channel beside two that the lobes explain: mixing would make three busy ones
  const Measurement m = test::small_measurement({24, 12, 16}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    for (double& v : f) v = 0.9 / 3.14159265;
    f[1] *= std::exp(0.8 * std::sin(7 * wi.z * wo.z));
  });
  EXPECT_EQ(encode::decorrelating_transform(m, grey, 1e-3), ChannelTransform::identity);
  EncodeOptions o;
  o.effort = 0;
  const EncodeResult r = compress(m, o);
  EXPECT_LT(r.summary.errors.back().log_mae, r.summary.errors.front().log_mae);
}

TEST(ChannelTransform, OneChannelHasNone) {
  const LobeSet one{1, {{LobeKind::lambert, 1, 1, {0.9}}}};
  EXPECT_EQ(encode::decorrelating_transform(test::bumpy_measurement({20, 10, 12}, 1), one, 1e-3), ChannelTransform::identity);
}

}  // namespace
}  // namespace brdf
