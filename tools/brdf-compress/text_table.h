// SPDX-License-Identifier: Apache-2.0
// A table of text cells, written for a terminal, as CSV or as Markdown.
#pragma once

#include <string>
#include <vector>

namespace brdf::cli {

struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  int left_columns = 1;  ///< first columns that hold words; the others are set to the right

  std::string terminal() const;
  std::string csv() const;
  std::string markdown() const;
};

/// `value` with `digits` significant digits, no exponent within reason; "-" when it is not finite.
std::string significant(double value, int digits = 3);
/// `value` with `decimals` digits after the point; "-" when it is not finite.
std::string fixed(double value, int decimals);

}  // namespace brdf::cli
