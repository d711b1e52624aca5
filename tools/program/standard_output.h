// SPDX-License-Identifier: Apache-2.0
// stdout with every failure reported.
#pragma once

#include <string>
#include <string_view>

namespace brdf::cli {

/// Buffered writer of stdout. A closed pipe or a full disk throws Error(io). What is not flushed is lost.
class StandardOutput {
 public:
  void write(std::string_view bytes);
  void flush();

 private:
  std::string buffer_;
};

/// Writes a whole report.
void print(std::string_view text);

}  // namespace brdf::cli
