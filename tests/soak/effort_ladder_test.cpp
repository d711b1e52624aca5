// SPDX-License-Identifier: Apache-2.0
// More effort is never a larger file at an equal error, beyond 1 %.
#include "support/slice_measurement.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>

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

TEST(EffortLadder, MoreIsNeverLarger) {
  expect_sizes_to_fall(test::bumpy_measurement(), {Metric::log_mae, 0.003}, lower);
  expect_sizes_to_fall(test::slice_measurement(), {Metric::log_mae, 0.02}, lower);
}

TEST(EffortLadder, MostIsNeverLarger) { expect_sizes_to_fall(test::bumpy_measurement({24, 12, 16}), {Metric::psnr_env, 40}, upper); }

}  // namespace
}  // namespace brdf
