// SPDX-License-Identifier: Apache-2.0
#include "fit_synthetic.h"

#include <brdf/error.h>
#include <brdf/fit.h>

#include <gtest/gtest.h>

#include <string>

namespace brdf::fit {
namespace {

TEST(FitOptions, DefaultsAndLimitsAreValid) {
  std::string why = "untouched";
  EXPECT_TRUE(FitOptions{}.is_valid(&why));
  EXPECT_EQ(why, "untouched");
  FitOptions o;
  o.max_lobes = 1, o.starts = 1, o.max_iterations = 1, o.samples = 100, o.threads = 1;
  EXPECT_TRUE(o.is_valid());
  o.max_lobes = 8;
  EXPECT_TRUE(o.is_valid());
}

TEST(FitOptions, NamesTheFieldTheValueAndTheRange) {
  struct {
    int FitOptions::*field;
    int bad;
    const char* name;
  } const cases[] = {{&FitOptions::max_lobes, 0, "max_lobes is 0; allowed are 1 to 8"},
                     {&FitOptions::max_lobes, 9, "max_lobes is 9; allowed are 1 to 8"},
                     {&FitOptions::starts, 0, "starts is 0"},
                     {&FitOptions::max_iterations, -3, "max_iterations is -3"},
                     {&FitOptions::samples, 99, "samples is 99; allowed are 100"},
                     {&FitOptions::threads, 0, "threads is 0"}};
  for (const auto& c : cases) {
    FitOptions o;
    o.*c.field = c.bad;
    std::string why;
    EXPECT_FALSE(o.is_valid());
    EXPECT_FALSE(o.is_valid(&why));
    EXPECT_NE(why.find(c.name), std::string::npos) << why;
    try {
      fit_lobes(Measurement{}, o);
      FAIL() << "accepted " << c.name;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::invalid_argument);
      EXPECT_EQ(e.what(), why);
    }
  }
}

}  // namespace
}  // namespace brdf::fit
