// SPDX-License-Identifier: Apache-2.0
#include "base/file_descriptor.h"
#include "base/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <optional>
#include <string>

namespace brdf::base {
namespace {

namespace fs = std::filesystem;

void write_fully(const FileDescriptor& file, std::span<const std::byte> bytes, const fs::path& path) {
  while (!bytes.empty()) {
    const ::ssize_t n = ::write(file.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw io_error(path, "write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

/// Complete on the disk, or an exception.
void write_and_sync(const FileDescriptor& file, std::span<const std::byte> bytes, const fs::path& path) {
  write_fully(file, bytes, path);
  if (::fsync(file.get()) != 0) throw io_error(path, "write", errno);
}

/// A name in the folder of `target` that is new at the time of asking.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  std::string name = "." + target.filename().string();
  name.resize(std::min<std::size_t>(name.size(), 200));  // of the 255 bytes that file systems allow
  return target.parent_path() / (name + "." + std::to_string(::getpid()) + "." + std::to_string(counter++) + ".tmp");
}

/// A named file that is removed unless it was moved away.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!moved_) ::unlink(path_.c_str());
  }
  const fs::path& path() const noexcept { return path_; }
  void moved() noexcept { moved_ = true; }

 private:
  fs::path path_;
  bool moved_ = false;
};

Error exists_already(const fs::path& target) {
  return {ErrorCode::io, target.string() + ": exists already and may not be overwritten"};
}

void rename_onto(TemporaryFile& from, const fs::path& target) {
  if (::rename(from.path().c_str(), target.c_str()) != 0) throw io_error(target, "replace the file", errno);
  from.moved();
}

/// Gives a complete file the name `target` only if that name is free.
void move_to_free_name(TemporaryFile& from, const fs::path& target) {
  if (::link(from.path().c_str(), target.c_str()) == 0) return;
  if (errno == EEXIST) throw exists_already(target);
  // No hard links on this file system: claim the name, then rename over the claim.
  const FileDescriptor claim(::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!claim && errno == EEXIST) throw exists_already(target);
  if (!claim) throw io_error(target, "create", errno);
  TemporaryFile placeholder(target);
  rename_onto(from, target);
  placeholder.moved();
}

/// Best effort: makes the new name survive a power failure. Not every file system can.
void sync_folder(const fs::path& folder) noexcept {
  const FileDescriptor dir(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (dir) (void)::fsync(dir.get());
}

std::string descriptor_path(const FileDescriptor& file) { return "/proc/self/fd/" + std::to_string(file.get()); }

bool link_descriptor(const FileDescriptor& file, const fs::path& name) noexcept {
  return ::linkat(AT_FDCWD, descriptor_path(file).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

/// Writes a file without a name first. False, with nothing left behind, where the system cannot do that.
bool write_by_unnamed_file(const fs::path& target, const fs::path& folder, std::span<const std::byte> bytes,
                           bool overwrite) {
  const FileDescriptor file(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (!file || ::access(descriptor_path(file).c_str(), F_OK) != 0) return false;
  write_and_sync(file, bytes, target);
  if (!overwrite) {
    if (link_descriptor(file, target)) return true;
    if (errno == EEXIST) throw exists_already(target);
    return false;
  }
  const fs::path name = temporary_name(target);
  if (!link_descriptor(file, name)) return false;
  TemporaryFile temporary(name);
  rename_onto(temporary, target);
  return true;
}

void write_by_named_file(const fs::path& target, std::span<const std::byte> bytes, bool overwrite) {
  const fs::path name = temporary_name(target);
  FileDescriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file) throw io_error(target, "create", errno);
  TemporaryFile temporary(name);
  write_and_sync(file, bytes, target);
  if (!file.close()) throw io_error(target, "write", errno);
  overwrite ? rename_onto(temporary, target) : move_to_free_name(temporary, target);
}

void write_to_device(const fs::path& path, std::span<const std::byte> bytes) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file) throw io_error(path, "open", errno);
  write_fully(file, bytes, path);
  if (!file.close()) throw io_error(path, "write", errno);
}

/// What a symbolic link points to, so that the link itself survives.
fs::path follow_links(const fs::path& path) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target;
}

}  // namespace

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes, bool overwrite) {
  struct ::stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw Error(ErrorCode::io, path.string() + ": is a directory, not a file");
    if (!S_ISREG(status.st_mode)) return write_to_device(path, bytes);
    if (!overwrite) throw exists_already(path);
  } else if (errno != ENOENT) {  // a loop of links, a name that is too long, a folder that is none or may not be searched
    throw io_error(path, "open", errno);
  }
  const fs::path target = follow_links(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!write_by_unnamed_file(target, folder, bytes, overwrite)) write_by_named_file(target, bytes, overwrite);
  sync_folder(folder);
}

}  // namespace brdf::base
