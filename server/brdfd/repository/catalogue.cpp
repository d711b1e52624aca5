// SPDX-License-Identifier: Apache-2.0
#include "repository/catalogue.h"

#include <algorithm>

namespace brdf::service {

VersionHandle Catalogue::find(std::string_view id) const {
  const auto at = std::lower_bound(materials_.begin(), materials_.end(), id, [](const VersionHandle& m, std::string_view name) { return m->id < name; });
  return at != materials_.end() && (*at)->id == id ? *at : nullptr;
}

std::size_t Catalogue::after(std::string_view id) const {
  const auto at = std::upper_bound(materials_.begin(), materials_.end(), id, [](std::string_view name, const VersionHandle& m) { return name < m->id; });
  return static_cast<std::size_t>(at - materials_.begin());
}

std::vector<CatalogueChange> changes_between(const Catalogue& before, const Catalogue& after) {
  std::vector<CatalogueChange> changes;
  auto a = before.materials().begin();
  auto b = after.materials().begin();
  const auto a_end = before.materials().end(), b_end = after.materials().end();
  while (a != a_end || b != b_end) {
    if (b == b_end || (a != a_end && (*a)->id < (*b)->id)) {
      changes.push_back({ChangeType::removed, *a++});
    } else if (a == a_end || (*b)->id < (*a)->id) {
      changes.push_back({ChangeType::added, *b++});
    } else {
      if ((*a)->version != (*b)->version) changes.push_back({ChangeType::replaced, *b});
      ++a;
      ++b;
    }
  }
  return changes;
}

}  // namespace brdf::service
