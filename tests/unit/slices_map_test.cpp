// SPDX-License-Identifier: Apache-2.0
// Slice coordinates against the reader's interpolation of the same table, which takes another way to every number.
#include "encode/slice_model.h"
#include "encode/slice_samples.h"
#include "slices/slice_map.h"
#include "slices/slice_table.h"
#include "support/slice_measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace brdf::slices {
namespace {

constexpr int finest = residual::max_ndf_step;

TEST(SliceMap, NodesComeBackFromTheirAngles) {
  const Measurement m = test::slice_measurement();
  const residual::SliceFrame frame = encode::slice_frame(m, finest).value();
  const SliceMap map(frame);
  ASSERT_EQ(map.slices(), 6U);
  for (std::size_t slice = 0; slice < map.slices(); ++slice)
    for (int j = 0; j < frame.half_height(); ++j)
      for (int i = 0; i < frame.width; ++i) {
        const double u = static_cast<double>(i) / (frame.width - 1), v = static_cast<double>(j) / (frame.height - 1);
        const SliceAngles at = map.angles(slice, u, v);
        const SlicePoint p = map.point(at, 0.5);
        const double where = static_cast<double>(p.slice) + static_cast<double>(p.fraction);
        EXPECT_NEAR(where, static_cast<double>(slice), 1e-5);
        EXPECT_NEAR(p.v, v, 2e-5) << slice << " " << i << " " << j;
        const bool grazing_row = v < 0.01 && slice + 1 == map.slices();  // nothing of a surface is seen from behind it
        if (!grazing_row) {
          EXPECT_NEAR(p.u, u, 1e-4) << slice << " " << i << " " << j;
        }
      }
}

TEST(SliceMap, SidesOfThePlaneOfIncidenceAreOne) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const double ix = 0.6 * uniform(random), oy = 0.6 * uniform(random), ox = 0.6 * uniform(random);
    const double iz = std::sqrt(1 - ix * ix), oz = std::sqrt(1 - ox * ox - oy * oy);
    const SliceAngles a = slice_angles(ix, 0, iz, ox, oy, oz), b = slice_angles(ix, 0, iz, ox, -oy, oz);
    EXPECT_EQ(a.theta_i, b.theta_i);
    EXPECT_EQ(a.u_h, b.u_h);
    EXPECT_EQ(a.v_h, b.v_h);
    EXPECT_GE(a.v_h, 0);
    EXPECT_LE(a.v_h, 0.5);
  }
}

TEST(SliceMap, DegenerateDirectionsStayFinite) {
  const SliceMap map(encode::slice_frame(test::slice_measurement(), 8).value());
  for (const double z : {1.0, 0.5, 1e-3, 1e-9}) {
    const double r = std::sqrt(1 - z * z);
    for (const SliceAngles& at : {slice_angles(0, 0, 1, 0, 0, 1), slice_angles(r, 0, z, r, 0, z), slice_angles(r, 0, z, -r, 0, z),
                                  slice_angles(0, 0, 1, r, 0, z), slice_angles(r, 0, z, 0, 0, 1)}) {
      const SlicePoint p = map.point(at, z);
      EXPECT_TRUE(std::isfinite(p.u) && std::isfinite(p.v) && std::isfinite(p.scale));
      EXPECT_GE(p.u, 0.0f);
      EXPECT_LE(p.u, 1.0f);
      EXPECT_GE(p.v, 0.0f);
      EXPECT_LE(p.v, 0.5f);
      EXPECT_GE(p.scale, 0.0f);
    }
  }
}

/// All coefficients of a measurement, without rounding.
residual::Coefficients all_coefficients(const Measurement& m, int ndf_step) {
  residual::Coefficients c;
  c.slices = encode::slice_frame(m, ndf_step).value();
  c.channels = m.channels.count;
  c.transform = residual::ChannelTransform::opponent;
  c.order = residual::coefficient_order(residual::order_shapes[0], false, residual::max_coefficients, residual::reach_of(c.slices));
  for (const auto& channel : encode::slice_coefficients(encode::sample_slices(m, c.slices), c.order, c.transform))
    c.values.emplace_back(channel.begin(), channel.end());
  return c;
}

class SliceTableAgainstReader : public testing::TestWithParam<double> {};

TEST_P(SliceTableAgainstReader, GivesTheMeasuredValue) {
  test::SliceShape shape;
  shape.alpha = GetParam();
  shape.ndf_nodes = 128;
  const Measurement m = test::slice_measurement(shape);
  const SliceTable table(all_coefficients(m, finest));
  const MeasurementInterpolator reference(m);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    Vec3d w{normal(random), normal(random), std::fabs(normal(random)) + 0.05};
    return w / std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
  };
  double worst = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec3d wi = direction(), wo = direction();
    if (wi.z < 0.09) continue;  // sigma falls to nothing within the last cells of the reader's table, which are wider
    std::vector<double> expected(3);
    ASSERT_TRUE(reference.eval(wi, wo, expected));
    float f[3];
    table.eval(slice_angles(wi.x, wi.y, wi.z, wo.x, wo.y, wo.z), wo.z, f);
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(static_cast<double>(f[c]) / expected[c] - 1));
  }
  // sigma is interpolated between other nodes here and there, theta_i is rounded to 16 bits
  EXPECT_LT(worst, 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Roughness, SliceTableAgainstReader, testing::Values(0.05, 0.2, 0.6));

TEST(SliceFrame, IsRefusedForWhatTheFormatCannotHold) {
  Measurement m = test::slice_measurement();
  EXPECT_TRUE(encode::slice_frame(m, 8));
  std::get<VisibleNormalTable>(m.table).jacobian = false;
  EXPECT_FALSE(encode::slice_frame(m, 8));
  m = test::slice_measurement();
  std::get<VisibleNormalTable>(m.table).ndf.back() += 0.5f;  // depends on azimuth
  EXPECT_FALSE(encode::slice_frame(m, 8));
}

}  // namespace
}  // namespace brdf::slices
