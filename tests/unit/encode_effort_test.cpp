// SPDX-License-Identifier: Apache-2.0
// More effort is never a larger file at an equal error, beyond 1 %.
#include "encode/effort.h"
#include "support/slice_measurement.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

namespace brdf {
namespace {

void expect_sizes_to_fall(const Measurement& m, ErrorTarget target, std::span<const int> efforts) {
  std::size_t before = SIZE_MAX;
  for (const int effort : efforts) {
    EncodeOptions o;
    o.effort = effort;
    o.target_error = target;
    const std::size_t size = compress(m, o).bytes.size();
    if (before != SIZE_MAX) {
      EXPECT_LE(static_cast<double>(size), 1.01 * static_cast<double>(before) + 1) << "effort " << effort;
    }
    before = std::min(before, size);
  }
}

constexpr int lower[] = {0, 25, 50}, upper[] = {50, 75, 100};

TEST(Effort, MoreIsNeverLargerSlow) {
  expect_sizes_to_fall(test::bumpy_measurement(), {Metric::log_mae, 0.003}, lower);
  expect_sizes_to_fall(test::slice_measurement(), {Metric::log_mae, 0.02}, lower);
}

TEST(Effort, MostIsNeverLargerSlow) { expect_sizes_to_fall(test::bumpy_measurement({24, 12, 16}), {Metric::psnr_env, 40}, upper); }

TEST(Effort, StepsOnlyAdd) {
  const auto steps = encode::effort_steps();
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const encode::EffortStep &a = steps[i - 1], &b = steps[i];
    EXPECT_LT(a.effort, b.effort);
    EXPECT_LE(a.max_lobes, b.max_lobes);
    EXPECT_LE(a.starts, b.starts);
    EXPECT_LE(a.fit_samples, b.fit_samples);
    EXPECT_LE(a.coefficients, b.coefficients);
    EXPECT_LE(a.passes, b.passes);
    EXPECT_LE(a.variants, b.variants);
    EXPECT_LE(a.slice_variants, b.slice_variants);
    EXPECT_LE(a.table_variants, b.table_variants);
    EXPECT_LE(a.verify_quality, b.verify_quality);
  }
}

TEST(Effort, TheTableHasAColumnForEveryStep) {
  const std::string table = effort_table();
  for (const Preset& p : presets()) EXPECT_NE(table.find(" " + std::string(p.name) + " |"), std::string::npos);
}

}  // namespace
}  // namespace brdf
