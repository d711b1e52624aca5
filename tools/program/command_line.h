// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace brdf::cli {

/// Name and arguments as a shell would take them again.
std::string command_line(const std::string& program, int argc, const char* const* argv);

}  // namespace brdf::cli
