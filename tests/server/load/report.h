// SPDX-License-Identifier: Apache-2.0
// What the load test says: one row for each figure that is asked for.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace brdf::load {

struct Row {
  std::string name;     ///< what is measured
  std::string asked;    ///< the bound
  std::string reached;  ///< the figure
  std::string ran;      ///< what was done to get it
  bool met = false;     ///< the bound is kept
  bool sound = true;    ///< nothing was wrong: no failed call, no mixed answer, no leak; what does not depend on how busy the machine is
  std::vector<std::pair<std::string, double>> figures;  ///< for --json
};

/// A table in Markdown.
std::string table_of(const std::vector<Row>& rows);
std::string json_of(const std::vector<Row>& rows);

/// "12.3", without digits that mean nothing.
std::string number(double value, int digits = 3);
/// "12.3 us", "4.5 ms", "1.2 s".
std::string duration(double seconds);

}  // namespace brdf::load
