// SPDX-License-Identifier: Apache-2.0
// Reading and writing of MERL tables. Expected numbers follow from the layout: value in 1/sr = raw * (1, 1.15, 1.66) / 1500.
#include <brdf/ingest.h>

#include "ingest/merl_writer.h"
#include "support/merl_bytes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace brdf {
namespace {

const HalfDifferenceTable& table_of(const Measurement& m) { return std::get<HalfDifferenceTable>(m.table); }

std::size_t cell_of(int i, int j, int k, int n_phi) {
  return static_cast<std::size_t>(k) + static_cast<std::size_t>(n_phi) * static_cast<std::size_t>(j + 90 * i);
}

/// Numbers over the whole range of float, a tenth of the cells invalid.
HalfDifferenceTable random_table(int n_phi, unsigned seed) {
  HalfDifferenceTable t;
  t.n_theta_h = t.n_theta_d = 90;
  t.n_phi_d = n_phi;
  t.full_circle = n_phi == 360;
  std::mt19937 random(seed);
  const std::size_t cells = cell_of(89, 89, n_phi - 1, n_phi) + 1;
  t.values.resize(3 * cells);
  t.valid.resize(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    t.valid[cell] = random() % 10 != 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const float any = std::bit_cast<float>(static_cast<std::uint32_t>(random() & 0x7fffffffu));
      t.values[3 * cell + c] = std::isfinite(any) ? any : std::numeric_limits<float>::max();
    }
  }
  return t;
}

TEST(IngestMerl, CellsAndScaleFollowTheLayout) {
  const auto bytes = test::merl_bytes(
      180, [](int c, int i, int j, int k) { return i == 3 && j == 5 && k == 7 ? 1500.0 * (c + 1) : 150.0; });
  const Measurement m = read_measurement(bytes, "folder/gold-paint.binary");
  const HalfDifferenceTable& t = table_of(m);
  EXPECT_EQ(t.n_theta_h, 90);
  EXPECT_EQ(t.n_theta_d, 90);
  EXPECT_EQ(t.n_phi_d, 180);
  EXPECT_FALSE(t.full_circle);
  ASSERT_EQ(t.values.size(), 3u * 1458000u);
  const std::size_t marked = 7 + 180 * (5 + 90 * 3);
  EXPECT_FLOAT_EQ(t.values[3 * marked], 1.0f);
  EXPECT_FLOAT_EQ(t.values[3 * marked + 1], 2.3f);
  EXPECT_FLOAT_EQ(t.values[3 * marked + 2], 4.98f);
  EXPECT_FLOAT_EQ(t.values[3 * marked + 3], 0.1f);
  EXPECT_EQ(m.provenance.name, "gold-paint");
  EXPECT_EQ(m.provenance.format, "MERL");
  EXPECT_EQ(m.provenance.file_bytes, 34992012u);
}

TEST(IngestMerl, AnyNegativeOrNonFiniteChannelMasksTheCell) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const auto bytes = test::merl_bytes(180, [&](int c, int i, int j, int k) {
    if (i != 0 || j != 0) return 1.0;
    if (k == 0) return c == 0 ? -1.0 : 1.0;
    if (k == 1) return c == 1 ? -1e-300 : 1.0;
    if (k == 2) return c == 2 ? nan : 1.0;
    if (k == 3) return c == 0 ? infinite : 1.0;
    if (k == 4) return c == 1 ? 1e300 : 1.0;  // no float
    if (k == 5) return -0.0;                  // zero is a measurement
    return 0.0;
  });
  const Measurement m = read_measurement(bytes, "x.binary");
  const auto& valid = table_of(m).valid;
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(valid[k], 0) << k;
  for (std::size_t k = 5; k < 180; ++k) EXPECT_EQ(valid[k], 1) << k;
  EXPECT_EQ(std::count(valid.begin(), valid.end(), 0), 5);
}

TEST(IngestMerl, FullCircleAndSamplePositionAreKept) {
  IngestOptions options;
  options.position = SamplePosition::centre;
  const Measurement m =
      read_measurement(test::merl_bytes(360, [](int, int, int, int k) { return 1500.0 * k; }), "full.binary", options);
  EXPECT_EQ(table_of(m).n_phi_d, 360);
  EXPECT_TRUE(table_of(m).full_circle);
  EXPECT_EQ(table_of(m).position, SamplePosition::centre);
  EXPECT_FLOAT_EQ(table_of(m).values[3 * 359], 359.0f);
}

TEST(IngestMerl, WhatIsWrittenReadsBackExactly) {
  for (const int n_phi : {180, 360}) {
    const HalfDifferenceTable t = random_table(n_phi, 7);
    const Measurement m = read_measurement(ingest::write_merl(t), "random.binary");
    ASSERT_EQ(table_of(m).valid, t.valid);
    std::size_t different = 0;
    for (std::size_t k = 0; k < t.values.size(); ++k) {
      if (t.valid[k / 3] != 0 && t.values[k] != table_of(m).values[k]) ++different;
    }
    EXPECT_EQ(different, 0u);
  }
}

TEST(IngestMerl, ContentHashIsThatOfTheBytes) {
  auto bytes = test::merl_bytes(180, [](int, int, int, int) { return 1.0; });
  const auto hash = read_measurement(bytes, "a.binary").provenance.content_hash;
  EXPECT_EQ(read_measurement(bytes, "b.binary").provenance.content_hash, hash);
  bytes.back() ^= std::byte{1};
  EXPECT_NE(read_measurement(bytes, "a.binary").provenance.content_hash, hash);
}

TEST(IngestMerlWriter, MarksCellsBelowTheHorizonAndThoseWithoutValue) {
  const auto cosine_i = [](const Vec3d& wi, const Vec3d& wo, std::span<double, 3> f) {
    EXPECT_GT(wi.z, 0);
    EXPECT_GT(wo.z, 0);
    f[0] = wi.z;
    f[1] = wo.z;
    f[2] = wo.z > 0.9 ? -1 : 1;  // a negative value cannot be stored
    return wi.z < 0.99;
  };
  const Measurement m = read_measurement(ingest::write_merl(cosine_i), "cosine.binary");
  const HalfDifferenceTable& t = table_of(m);
  std::size_t valid = 0;
  for (int i = 0; i < 90; i += 7) {
    const double theta_h = (i / 90.0) * (i / 90.0) * 1.5707963267948966;
    for (int j = 0; j < 90; ++j) {
      for (int k = 0; k < 180; k += 3) {
        const double theta_d = j * 0.017453292519943295, phi_d = k * 0.017453292519943295;
        const double a = std::cos(theta_h) * std::cos(theta_d);
        const double b = std::sin(theta_h) * std::sin(theta_d) * std::cos(phi_d);
        const double cos_i = a - b, cos_o = a + b;
        const std::size_t cell = cell_of(i, j, k, 180);
        const bool expected = cos_i > 1e-9 && cos_o > 1e-9 && cos_i < 0.99 && cos_o <= 0.9;
        ASSERT_EQ(t.valid[cell] != 0, expected) << i << " " << j << " " << k;
        if (!expected) continue;
        ++valid;
        ASSERT_NEAR(t.values[3 * cell], cos_i, 1e-6);
        ASSERT_NEAR(t.values[3 * cell + 1], cos_o, 1e-6);
      }
    }
  }
  EXPECT_GT(valid, 10000u);
}

TEST(IngestMerlWriter, ShareOfCellsAboveTheHorizonIsThatOfTheGrid) {
  const auto one = [](const Vec3d&, const Vec3d&, std::span<double, 3> f) {
    f[0] = f[1] = f[2] = 1;
    return true;
  };
  const Measurement m = read_measurement(ingest::write_merl(one), "one.binary");
  const auto& valid = table_of(m).valid;
  const double share = static_cast<double>(std::count(valid.begin(), valid.end(), 1)) / 1458000.0;
  EXPECT_NEAR(share, 0.762, 0.0006);
}

TEST(IngestMerlWriter, SamplesAtBinCentresWhenAsked) {
  const auto cosine_i = [](const Vec3d& wi, const Vec3d&, std::span<double, 3> f) {
    f[0] = f[1] = f[2] = wi.z;
    return true;
  };
  const Measurement m = read_measurement(ingest::write_merl(cosine_i, SamplePosition::centre, true), "centre.binary");
  EXPECT_EQ(table_of(m).n_phi_d, 360);
  const double theta_h = std::pow(20.5 / 90, 2) * 1.5707963267948966, degree = 0.017453292519943295;
  const double cos_i = std::cos(theta_h) * std::cos(30.5 * degree) -
                       std::sin(theta_h) * std::sin(30.5 * degree) * std::cos(200.5 * degree);
  EXPECT_NEAR(table_of(m).values[3 * cell_of(20, 30, 200, 360)], cos_i, 1e-6);
}

}  // namespace
}  // namespace brdf
