// SPDX-License-Identifier: Apache-2.0
// The list of bounds itself. This is what tools/measure-numerics --check runs to learn it.
#include "support/numeric_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace brdf::test {
namespace {

TEST(NumericBounds, EachIsNamedOnceAndSaysWhatItCounts) {
  std::set<std::string> names;
  for (const NumericBound* b : numeric_bounds()) {
    EXPECT_TRUE(names.insert(b->group() + ": " + b->what()).second) << b->group() << ", " << b->what();
    EXPECT_FALSE(b->unit().empty()) << b->what();
    EXPECT_TRUE(std::isfinite(b->bound()) && b->bound() >= 0) << b->what();
  }
}

}  // namespace
}  // namespace brdf::test
