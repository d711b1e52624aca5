// SPDX-License-Identifier: Apache-2.0
// Fetched files on the disk, named by their content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brdf::client {

/// Several processes may share a folder. Nothing that is found is trusted: its content must have the hash of its name.
class FileCache {
 public:
  FileCache(std::filesystem::path folder, std::uint64_t max_bytes) : folder_(std::move(folder)), max_bytes_(max_bytes) {}

  bool enabled() const noexcept { return !folder_.empty(); }
  /// Of a version (service::version_of of the bytes); nothing where it is missing or damaged.
  std::optional<std::vector<std::byte>> find(const std::string& version) const;
  /// A cache that cannot be written is a slow cache, no error.
  void store(const std::string& version, std::span<const std::byte> bytes) const noexcept;

 private:
  std::filesystem::path path_of(const std::string& version) const;
  void drop_oldest() const;

  std::filesystem::path folder_;
  std::uint64_t max_bytes_;
};

}  // namespace brdf::client
