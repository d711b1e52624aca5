// SPDX-License-Identifier: Apache-2.0
// Rows of numbers from stdin, block by block.
#pragma once

#include "row_format.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace brdf::cli {

/// Reads rows of `columns` finite numbers from a file descriptor. Memory does not grow with the input. Throws
/// Failure(bad_input) that names the line or row: a malformed or partial one, or a number that is not finite.
class RowReader {
 public:
  RowReader(int descriptor, RowFormat format, std::size_t columns)
      : descriptor_(descriptor), format_(format), columns_(columns) {}

  /// Fills whole rows of `out` (a multiple of `columns` numbers) and returns how many; 0 at the end.
  std::size_t read(std::span<float> out);

 private:
  std::size_t read_binary(std::span<float> out);
  std::size_t read_text(std::span<float> out);
  bool next_line(std::string_view& line);
  void parse(std::string_view line, std::span<float> row) const;
  bool fill();

  int descriptor_;
  RowFormat format_;
  std::size_t columns_;
  std::string buffer_;
  std::size_t at_ = 0;
  bool ended_ = false;
  std::uint64_t line_ = 0, row_ = 0;
};

}  // namespace brdf::cli
