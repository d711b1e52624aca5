// SPDX-License-Identifier: Apache-2.0
// What goes to stderr. stdout carries data only.
#pragma once

#include <string>

namespace brdf::cli {

/// -q, -v and --json of a verb.
struct Reporting {
  bool json = false;
  bool quiet = false;
  bool verbose = false;

  /// A line for people, unless -q or --json.
  void say(const std::string& line) const;
  /// A line that only -v shows.
  void detail(const std::string& line) const;
};

/// Name that begins every complaint and the schema of every report; main sets it once.
void set_program_name(const std::string& name);
const std::string& program_name() noexcept;

/// "brdf-compress: sentence". Shown always.
void complain(const std::string& sentence);

}  // namespace brdf::cli
