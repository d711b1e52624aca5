// SPDX-License-Identifier: Apache-2.0
#include "client/file_cache.h"

#include "base/file_io.h"
#include "shared/content_hash.h"

#include <brdf/error.h>
#include <brdf/limits.h>

#include <algorithm>

namespace brdf::client {

namespace fs = std::filesystem;

namespace {

/// The last used go last. The system's own times of new files are some milliseconds behind this clock.
void mark_used(const fs::path& path) noexcept {
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
}

}  // namespace

fs::path FileCache::path_of(const std::string& version) const { return folder_ / (version + ".brdfc"); }

std::optional<std::vector<std::byte>> FileCache::find(const std::string& version) const {
  if (!enabled() || !service::is_version(version)) return std::nullopt;
  const fs::path path = path_of(version);
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  try {
    std::vector<std::byte> bytes = base::read_file(path, DecodeLimits{}.max_file_bytes);
    if (service::version_of(bytes) != version) {
      fs::remove(path, error);
      return std::nullopt;
    }
    mark_used(path);
    return bytes;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void FileCache::store(const std::string& version, std::span<const std::byte> bytes) const noexcept {
  if (!enabled()) return;
  try {
    fs::create_directories(folder_);
    base::write_file_atomically(path_of(version), bytes, true);
    mark_used(path_of(version));
    drop_oldest();
  } catch (const std::exception&) {
  }
}

void FileCache::drop_oldest() const {
  struct Kept {
    fs::file_time_type used;
    std::uint64_t bytes;
    fs::path path;
  };
  std::vector<Kept> kept;
  std::uint64_t sum = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().extension() != ".brdfc" || !entry.is_regular_file(error)) continue;
    const std::uint64_t bytes = entry.file_size(error);
    if (error) continue;  // another process took it away
    kept.push_back({entry.last_write_time(error), bytes, entry.path()});
    sum += bytes;
  }
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (auto at = kept.begin(); sum > max_bytes_ && at + 1 < kept.end(); ++at) {
    fs::remove(at->path, error);
    sum -= at->bytes;
  }
}

}  // namespace brdf::client
