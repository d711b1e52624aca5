// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include "ingest/printable_text.h"

#include <iostream>

namespace brdf::cli {

void Reporting::say(const std::string& line) const {
  if (!quiet && !json) std::cerr << line << '\n';
}

void Reporting::detail(const std::string& line) const {
  if (verbose && !quiet) std::cerr << line << '\n';
}

void complain(const std::string& sentence) {
  constexpr std::size_t longest = std::size_t{1} << 14;  // names of files may hold line ends and what a terminal obeys
  std::cerr << "brdf-compress: " << ingest::printable_text(sentence, longest) << '\n';
}

}  // namespace brdf::cli
