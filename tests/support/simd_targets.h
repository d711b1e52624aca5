// SPDX-License-Identifier: Apache-2.0
// Runs code once on every instruction set that this machine has.
#pragma once

#include "base/highway_targets.h"  // the targets of the library, not of the test

#include <brdf/material.h>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cstdint>

namespace brdf::test {

/// Restricts dispatch to one target while it lives.
class UseTarget {
 public:
  explicit UseTarget(std::int64_t target) { use(target); }
  ~UseTarget() { use(0); }
  UseTarget(const UseTarget&) = delete;
  UseTarget& operator=(const UseTarget&) = delete;

 private:
  static void use(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

/// Calls `work()` on every target; failures name it.
template <class Work>
void on_every_target(Work&& work) {
  int count = 0;
  for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
    const UseTarget use(rest & -rest);
    SCOPED_TRACE(simd_target());
    work();
    ++count;
  }
  ASSERT_GE(count, 1);
}

}  // namespace brdf::test
