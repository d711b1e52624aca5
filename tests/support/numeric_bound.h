// SPDX-License-Identifier: Apache-2.0
// Stated bounds of numerical error, the worst case found for each, and their record.
//
// A bound is declared at namespace scope, so that the program knows all of its bounds even when no test runs. When the
// environment names a file in BRDF_NUMERICS_JSON, the program writes there, at its end, every bound and what was found;
// tools/measure-numerics makes docs/numerics.md of it.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace brdf::test {

/// One bound. Not made for use by several threads at once.
class NumericBound {
 public:
  /// `group` and `what` together name the bound. `unit` says what is counted.
  NumericBound(std::string group, std::string what, std::string unit, double bound);
  NumericBound(const NumericBound&) = delete;
  NumericBound& operator=(const NumericBound&) = delete;

  /// Keeps the worst value. `where()` gives a few words and is asked only for a new worst one. What is no number is worse
  /// than any number.
  template <class Where>
  void see(double value, Where&& where) {
    ++cases_;
    if (value <= worst_) return;
    worst_ = value == value ? value : beyond_all;
    where_ = where();
  }

  /// Fails the running test unless something was seen and nothing beyond the bound.
  void check() const;

  const std::string& group() const noexcept { return group_; }
  const std::string& what() const noexcept { return what_; }
  const std::string& unit() const noexcept { return unit_; }
  double bound() const noexcept { return bound_; }
  double worst() const noexcept { return worst_; }
  const std::string& where() const noexcept { return where_; }
  std::uint64_t cases() const noexcept { return cases_; }

 private:
  static constexpr double beyond_all = 1e300;
  std::string group_, what_, unit_, where_;
  double bound_, worst_ = -1;
  std::uint64_t cases_ = 0;
};

/// Every bound of this program, in the order of declaration.
const std::vector<const NumericBound*>& numeric_bounds();

/// Printed with as many digits as tell floats apart.
std::string numbers(std::initializer_list<double> values);

}  // namespace brdf::test
