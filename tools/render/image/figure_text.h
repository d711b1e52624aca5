// SPDX-License-Identifier: Apache-2.0
// Figures of a comparison as text, the same in the table and on the picture.
#pragma once

#include "image/comparison.h"

#include <string>
#include <vector>

namespace brdf::render {

/// One row of the table.
struct FigureRow {
  const char* name;  ///< for people
  const char* key;   ///< for JSON
  Figure figure;
  const char* format;  ///< of printf, for one double
};

/// All figures of a comparison in the order in which they are told.
std::vector<FigureRow> figure_rows(const ComparisonResult& result);

/// `value` in a row's format; "-" for none.
std::string figure_text(const FigureRow& row, std::optional<double> value);

/// "FLIP 0.0132, noise 0.0021"; without a floor the first half alone.
std::string figure_line(const FigureRow& row);

}  // namespace brdf::render
