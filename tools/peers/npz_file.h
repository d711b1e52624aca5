// SPDX-License-Identifier: Apache-2.0
// Arrays of floats in NumPy's .npz: a zip archive of .npy files, stored or deflated.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brdf::peers {

/// Nothing is trusted: the archive and each array are bounded before they are allocated. Reads from memory, so nothing of
/// the file is open once it is made.
class NpzFile {
 public:
  /// Throws Error (io, limit_exceeded, malformed); the sentence starts with the path.
  explicit NpzFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const noexcept { return path_; }

  /// The values of the array `name`, or nothing where the archive has none of that name. Throws Error: malformed,
  /// truncated, limit_exceeded, and unsupported for what is no array of one axis of little-endian float32 or float64.
  std::optional<std::vector<float>> floats(const std::string& name) const;

 private:
  std::filesystem::path path_;
  std::vector<std::byte> bytes_;
};

}  // namespace brdf::peers
