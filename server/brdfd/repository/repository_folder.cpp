// SPDX-License-Identifier: Apache-2.0
#include "repository/repository_folder.h"

#include "base/file_io.h"
#include "shared/material_name.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace brdf::service {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view extension = ".brdfc";

std::int64_t nanoseconds(const timespec& t) noexcept { return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec; }

FileStamp stamp_of(const struct stat& s) noexcept {
  return {s.st_ino, static_cast<std::uint64_t>(s.st_size), nanoseconds(s.st_mtim), nanoseconds(s.st_ctim)};
}

}  // namespace

RepositoryFolder::RepositoryFolder(fs::path path) : path_(std::move(path)), root_(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (!root_) throw base::io_error(path_, "open the repository", errno);
}

base::FileDescriptor RepositoryFolder::open_beneath(const std::string& file) const {
  open_how how{};
  how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;  // a pipe must not block the daemon
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  long fd = ::syscall(SYS_openat2, root_.get(), file.c_str(), &how, sizeof(how));
  // Linux before 5.6, and sandboxes that do not know the call: no link at all is followed.
  if (fd < 0 && (errno == ENOSYS || errno == EPERM)) fd = ::openat(root_.get(), file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
  return base::FileDescriptor(static_cast<int>(fd));
}

std::vector<FolderEntry> RepositoryFolder::list() const {
  std::vector<FolderEntry> entries;
  std::error_code error;
  fs::directory_iterator at(path_, error);
  if (error) throw base::io_error(path_, "list", error.value());
  for (const fs::directory_iterator end; at != end; at.increment(error)) {
    std::string name = at->path().filename().string();
    if (!name.ends_with(extension)) continue;
    name.resize(name.size() - extension.size());
    if (!is_material_id(name)) continue;
    struct stat s {};
    // A link's target is stamped: that is what changes. One that leads outside is refused when it is read.
    if (::fstatat(root_.get(), at->path().filename().c_str(), &s, 0) != 0 || !S_ISREG(s.st_mode)) continue;
    entries.push_back({std::move(name), stamp_of(s)});
  }
  if (error) throw base::io_error(path_, "list", error.value());
  std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) { return a.id < b.id; });
  return entries;
}

RepositoryFolder::Content RepositoryFolder::read(const std::string& id, std::uint64_t max_bytes) const {
  const std::string file = id + std::string(extension);
  if (!is_material_id(id)) throw Error(ErrorCode::invalid_argument, "'" + id + "' is no name of a material");
  const base::FileDescriptor fd = open_beneath(file);
  if (!fd) {
    if (errno == EXDEV || errno == ELOOP) throw Error(ErrorCode::io, file + ": is a link that leaves the repository");
    throw base::io_error(file, "open", errno);
  }
  struct stat before {};
  if (::fstat(fd.get(), &before) != 0) throw base::io_error(file, "read", errno);
  if (!S_ISREG(before.st_mode)) throw Error(ErrorCode::io, file + ": is no regular file");
  Content content;
  content.stamp = stamp_of(before);
  if (content.stamp.bytes > max_bytes) {
    throw Error(ErrorCode::limit_exceeded, file + ": has " + std::to_string(content.stamp.bytes) + " bytes, the limit is " + std::to_string(max_bytes));
  }
  content.bytes.resize(static_cast<std::size_t>(content.stamp.bytes));
  for (std::size_t done = 0; done < content.bytes.size();) {
    const ::ssize_t n = ::read(fd.get(), content.bytes.data() + done, content.bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw base::io_error(file, "read", errno);
    if (n == 0) throw Error(ErrorCode::truncated, file + ": became shorter while it was read");
    done += static_cast<std::size_t>(n);
  }
  return content;
}

void RepositoryFolder::write(const std::string& id, std::span<const std::byte> bytes, bool overwrite) const {
  if (!is_material_id(id)) throw Error(ErrorCode::invalid_argument, "'" + id + "' is no name of a material");
  const fs::path path = path_ / (id + std::string(extension));
  // The library follows a link to replace its target, which may lie anywhere.
  if (fs::is_symlink(fs::symlink_status(path))) throw Error(ErrorCode::io, path.filename().string() + ": is a link, which is not replaced");
  base::write_file_atomically(path, bytes, overwrite);
}

}  // namespace brdf::service
