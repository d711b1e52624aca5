// SPDX-License-Identifier: Apache-2.0
// Owner of a POSIX file descriptor, and the one sentence for what the system refuses.
#pragma once

#include <brdf/error.h>

#include <unistd.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace brdf::base {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) noexcept : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  explicit operator bool() const noexcept { return fd_ >= 0; }
  int get() const noexcept { return fd_; }

  /// Closes now. Some file systems report a failed write only here. False with errno set when it failed.
  bool close() noexcept { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

/// Error(io) "path: cannot do: reason", where `error` is an errno.
inline Error io_error(const std::filesystem::path& path, std::string_view what, int error) {
  // strerror is not thread-safe, this is
  return {ErrorCode::io,
          path.string() + ": cannot " + std::string(what) + ": " + std::generic_category().message(error)};
}

}  // namespace brdf::base
