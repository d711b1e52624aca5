// SPDX-License-Identifier: Apache-2.0
#include "parse_arguments.h"

#include "messages.h"
#include "standard_output.h"

#include <algorithm>
#include <sstream>

namespace brdf::cli {

ExitCode parse_and_run(CLI::App& program, std::vector<std::string> arguments, const std::function<ExitCode()>& chosen) {
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the last to the first
  try {
    program.parse(arguments);
    return chosen();
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) {
      const auto verbs = program.get_subcommands();
      const std::string verb = verbs.empty() ? "" : verbs.front()->get_name() + " ";
      complain(std::string(e.what()) + "; see " + program.get_name() + " " + verb + "--help");
      return ExitCode::usage;
    }
    std::ostringstream text;  // --help or --version
    program.exit(e, text, text);
    print(text.str());
    return ExitCode::ok;
  }
}

}  // namespace brdf::cli
