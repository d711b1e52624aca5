// SPDX-License-Identifier: Apache-2.0
// Decoded materials: built when first asked for, dropped when others need the room.
#pragma once

#include "repository/material_version.h"

#include <condition_variable>
#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

namespace brdf::service {

/// Thread-safe. Handles stay valid after their entry is dropped; the budget counts what the cache holds.
class TableCache {
 public:
  explicit TableCache(std::uint64_t budget_bytes, DecodeLimits limits = {}) : budget_(budget_bytes), limits_(limits) {}

  /// The material of the first `bytes` bytes (MaterialVersion::cut_at), prepared so. Of several that ask for the same at once, one builds and the others wait. Throws Error.
  Material get(const VersionHandle& version, EvalLevel level, std::uint64_t bytes, bool sampling);

  /// The same where it is complete; builds and waits for nothing.
  std::optional<Material> find(const MaterialVersion& version, EvalLevel level, std::uint64_t bytes, bool sampling);

  std::uint64_t bytes() const;
  std::uint64_t budget() const noexcept { return budget_; }
  std::uint64_t built() const;    ///< since the start
  std::uint64_t dropped() const;  ///< since the start

 private:
  using Key = std::tuple<std::string, EvalLevel, std::uint64_t, bool>;  // version: two names of one content share
  struct Entry {
    std::optional<Material> material;  ///< nothing while it is built
    std::uint64_t bytes = 0;
    std::list<Key>::iterator used;
  };

  void drop_to_budget(const Key& keep);

  const std::uint64_t budget_;
  const DecodeLimits limits_;
  mutable std::mutex mutex_;
  std::condition_variable built_one_;
  std::map<Key, Entry> entries_;
  std::list<Key> order_;  ///< the last used first; entries that are complete
  std::uint64_t bytes_ = 0, built_ = 0, dropped_ = 0;
};

}  // namespace brdf::service
