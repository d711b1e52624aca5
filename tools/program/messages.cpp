// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include "ingest/printable_text.h"

#include <iostream>

namespace brdf::cli {
namespace {

std::string& name() noexcept {
  static std::string n;
  return n;
}

}  // namespace

void set_program_name(const std::string& program) { name() = program; }

const std::string& program_name() noexcept { return name(); }

void Reporting::say(const std::string& line) const {
  if (!quiet && !json) std::cerr << line << '\n';
}

void Reporting::detail(const std::string& line) const {
  if (verbose && !quiet) std::cerr << line << '\n';
}

void complain(const std::string& sentence) {
  constexpr std::size_t longest = std::size_t{1} << 14;  // names of files may hold line ends and what a terminal obeys
  std::cerr << program_name() << ": " << ingest::printable_text(sentence, longest) << '\n';
}

}  // namespace brdf::cli
