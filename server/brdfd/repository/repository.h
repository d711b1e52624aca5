// SPDX-License-Identifier: Apache-2.0
// Keeps the catalogue in step with the folder: load, verify, swap.
#pragma once

#include "repository/catalogue.h"
#include "repository/repository_folder.h"

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace brdf::service {

enum class RepositoryMode { none, poll, manual };
RepositoryMode repository_mode(std::string_view name);

struct Refusal {
  std::string id, reason;
};

struct PollResult {
  std::uint32_t materials = 0, added = 0, replaced = 0, removed = 0;
  std::vector<Refusal> refused;  ///< newly or still; an older version goes on serving
};

struct RepositoryLimits {
  std::uint64_t max_materials = 100'000;
  DecodeLimits decode;
};

/// Thread-safe: changes queue up behind one mutex, reading the catalogue waits for none of them.
class Repository {
 public:
  Repository(std::filesystem::path path, RepositoryMode mode, RepositoryLimits limits);

  RepositoryMode mode() const noexcept { return mode_; }
  CatalogueHandle catalogue() const { return current_.get(); }

  /// Looks at the folder: what is new or changed is read and verified, then all of it is swapped in at once. A file that
  /// cannot be verified leaves its old version as it is. In the mode manual only what is loaded is looked at.
  /// Throws Error(io) where the folder cannot be listed; the catalogue stays.
  PollResult poll();

  /// Mode manual. Throws Error: invalid_argument in another mode, and what reading and verifying throw.
  VersionHandle load(const std::string& id);
  /// False where it was not loaded. Throws Error(invalid_argument) in another mode.
  bool unload(const std::string& id);

  /// Writes a verified file and serves it at once, in every mode. Throws Error: io (also where it exists and may not be
  /// replaced), and what verifying throws.
  VersionHandle publish(const std::string& id, std::vector<std::byte> bytes, bool overwrite);

  /// Called after each swap with both catalogues, from the thread that changed it; set before the first change.
  using Listener = std::function<void(const CatalogueHandle& before, const CatalogueHandle& after)>;
  void on_change(Listener listener) { listener_ = std::move(listener); }

 private:
  struct Seen {
    FileStamp stamp;
    bool settled = false;  ///< the stamp is old enough that another write would have changed it
    std::string refused;   ///< why the file is not served; empty: it is
  };

  void require_manual() const;
  /// Throws Error(limit_exceeded) where `id` would be one too many.
  void require_room(const Catalogue& catalogue, const std::string& id) const;
  VersionHandle read_version(const std::string& id, Seen& seen) const;
  void swap(std::vector<VersionHandle> sorted);
  void replace_one(const std::string& id, VersionHandle version);

  const RepositoryFolder folder_;
  const RepositoryMode mode_;
  const RepositoryLimits limits_;
  Listener listener_;
  std::mutex changing_;
  std::map<std::string, Seen, std::less<>> seen_;
  CurrentCatalogue current_;
};

}  // namespace brdf::service
