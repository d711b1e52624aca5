// SPDX-License-Identifier: Apache-2.0
// One thing that `verify` looked at.
#pragma once

#include <string>
#include <vector>

namespace brdf::cli {

struct Check {
  std::string name;
  bool ok = false;
  double value = 0;     ///< what was found
  std::string allowed;  ///< e.g. "at most 0.01"
  std::string note;     ///< where, or how many
};

using Checks = std::vector<Check>;

}  // namespace brdf::cli
