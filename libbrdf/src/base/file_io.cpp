// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"

#include "base/file_descriptor.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <string>

namespace brdf::base {
namespace {

/// Reads up to `size` bytes; fewer only at the end of the file.
std::size_t read_fully(const FileDescriptor& file, std::byte* out, std::size_t size,
                       const std::filesystem::path& path) {
  std::size_t done = 0;
  while (done < size) {
    const ::ssize_t n = ::read(file.get(), out + done, size - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw io_error(path, "read", errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

Error too_large(const std::filesystem::path& path, const std::string& found, std::uint64_t max_bytes) {
  return {ErrorCode::limit_exceeded,
          path.string() + ": the file has " + found + " bytes, the limit is " + std::to_string(max_bytes)};
}

constexpr std::size_t head_bytes = 512;

/// A pipe does not say how much will come.
std::vector<std::byte> read_until_end(const FileDescriptor& file, const std::filesystem::path& path,
                                      std::uint64_t max_bytes, const HeadCheck& check_head) {
  constexpr std::size_t step = std::size_t{1} << 16;
  std::vector<std::byte> bytes(head_bytes);
  bytes.resize(read_fully(file, bytes.data(), head_bytes, path));
  if (check_head) check_head(bytes, 0);
  if (bytes.size() < head_bytes && bytes.size() <= max_bytes) return bytes;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + step);
    const std::size_t got = read_fully(file, bytes.data() + before, step, path);
    bytes.resize(before + got);
    if (bytes.size() > max_bytes) throw too_large(path, "more than " + std::to_string(max_bytes), max_bytes);
    if (got < step) return bytes;
  }
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes, const HeadCheck& check_head) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) throw io_error(path, "open", errno);
  struct ::stat status {};
  if (::fstat(file.get(), &status) != 0) throw io_error(path, "stat", errno);
  if (S_ISDIR(status.st_mode)) throw Error(ErrorCode::io, path.string() + ": is a directory, not a file");
  if (!S_ISREG(status.st_mode)) return read_until_end(file, path, max_bytes, check_head);

  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_bytes) throw too_large(path, std::to_string(size), max_bytes);
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::min<std::uint64_t>(size, head_bytes)));
  std::size_t got = read_fully(file, bytes.data(), bytes.size(), path);
  if (got == bytes.size()) {
    if (check_head) check_head(bytes, size);
    bytes.resize(static_cast<std::size_t>(size));
    got += read_fully(file, bytes.data() + got, bytes.size() - got, path);
  }
  if (got != size) {
    throw Error(ErrorCode::truncated, path.string() + ": only " + std::to_string(got) + " of " + std::to_string(size) +
                                          " bytes could be read; the file changed meanwhile");
  }
  return bytes;
}

}  // namespace brdf::base
