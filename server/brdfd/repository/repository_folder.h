// SPDX-License-Identifier: Apache-2.0
// The folder of .brdfc files. Nothing outside it is read, whatever a name or a symbolic link says.
#pragma once

#include "base/file_descriptor.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace brdf::service {

/// Changes whenever a file was replaced or rewritten.
struct FileStamp {
  std::uint64_t inode = 0, bytes = 0;
  std::int64_t modified_ns = 0, changed_ns = 0;
  bool operator==(const FileStamp&) const = default;
};

struct FolderEntry {
  std::string id;
  FileStamp stamp;
};

/// Immutable and thread-safe.
class RepositoryFolder {
 public:
  /// Throws Error(io).
  explicit RepositoryFolder(std::filesystem::path path);

  const std::filesystem::path& path() const noexcept { return path_; }

  /// Files NAME.brdfc whose name is a material id, by name. Throws Error(io).
  std::vector<FolderEntry> list() const;

  struct Content {
    std::vector<std::byte> bytes;
    FileStamp stamp;
  };
  /// Throws Error: io (missing, a folder, or a link that leaves the root), limit_exceeded, truncated.
  Content read(const std::string& id, std::uint64_t max_bytes) const;

  /// Writes NAME.brdfc so that others see the old file or the whole new one. Throws Error(io).
  void write(const std::string& id, std::span<const std::byte> bytes, bool overwrite) const;

 private:
  base::FileDescriptor open_beneath(const std::string& file) const;

  std::filesystem::path path_;
  base::FileDescriptor root_;
};

}  // namespace brdf::service
