// SPDX-License-Identifier: Apache-2.0
// Rows of numbers to stdout.
#pragma once

#include "row_format.h"
#include "standard_output.h"

#include <cstddef>
#include <span>
#include <string>

namespace brdf::cli {

/// Text holds the shortest decimal that reads back as the same float. Throws Error(io).
class RowWriter {
 public:
  RowWriter(RowFormat format, std::size_t columns) : format_(format), columns_(columns) {}

  /// Whole rows, one after the other.
  void write(std::span<const float> values);
  void flush() { out_.flush(); }

 private:
  StandardOutput out_;
  RowFormat format_;
  std::size_t columns_;
  std::string text_;
};

}  // namespace brdf::cli
