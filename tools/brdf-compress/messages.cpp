// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include <iostream>

namespace brdf::cli {

void Reporting::say(const std::string& line) const {
  if (!quiet && !json) std::cerr << line << '\n';
}

void Reporting::detail(const std::string& line) const {
  if (verbose && !quiet) std::cerr << line << '\n';
}

void complain(const std::string& sentence) { std::cerr << "brdf-compress: " << sentence << '\n'; }

}  // namespace brdf::cli
