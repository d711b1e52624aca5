// SPDX-License-Identifier: Apache-2.0
// What is served at one moment.
#pragma once

#include "repository/material_version.h"

#include <mutex>
#include <string_view>
#include <vector>

namespace brdf::service {

/// Immutable and thread-safe; sorted by id.
class Catalogue {
 public:
  Catalogue() = default;
  explicit Catalogue(std::vector<VersionHandle> sorted) : materials_(std::move(sorted)) {}

  const std::vector<VersionHandle>& materials() const noexcept { return materials_; }
  /// Null where there is none.
  VersionHandle find(std::string_view id) const;
  /// Index of the first material behind `id`.
  std::size_t after(std::string_view id) const;

 private:
  std::vector<VersionHandle> materials_;
};

using CatalogueHandle = std::shared_ptr<const Catalogue>;

/// The catalogue of now. A call takes it once; a swap costs those that hold the old one nothing.
class CurrentCatalogue {
 public:
  CatalogueHandle get() const {
    const std::lock_guard lock(mutex_);
    return catalogue_;
  }
  void set(CatalogueHandle next) {
    const std::lock_guard lock(mutex_);
    catalogue_.swap(next);  // the old one is released after the lock
  }

 private:
  mutable std::mutex mutex_;
  CatalogueHandle catalogue_ = std::make_shared<const Catalogue>();
};

enum class ChangeType { added, replaced, removed };

struct CatalogueChange {
  ChangeType type;
  VersionHandle material;  ///< the new version, or the removed one
};

/// What happened between two catalogues, by id.
std::vector<CatalogueChange> changes_between(const Catalogue& before, const Catalogue& after);

}  // namespace brdf::service
