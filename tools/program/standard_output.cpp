// SPDX-License-Identifier: Apache-2.0
#include "standard_output.h"

#include "base/file_descriptor.h"

#include <cerrno>

namespace brdf::cli {

void StandardOutput::write(std::string_view bytes) {
  constexpr std::size_t enough = std::size_t{1} << 16;
  buffer_ += bytes;
  if (buffer_.size() >= enough) flush();
}

void StandardOutput::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ::ssize_t n = ::write(STDOUT_FILENO, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw base::io_error("standard output", "write", errno);
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  buffer_.clear();
}

void print(std::string_view text) {
  StandardOutput out;
  out.write(text);
  out.flush();
}

}  // namespace brdf::cli
