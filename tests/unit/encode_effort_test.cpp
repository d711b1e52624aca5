// SPDX-License-Identifier: Apache-2.0
// The table of efforts; that more of it is never a larger file is measured in soak/effort_ladder_test.cpp.
#include "encode/effort.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

namespace brdf {
namespace {

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
