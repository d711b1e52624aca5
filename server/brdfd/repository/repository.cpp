// SPDX-License-Identifier: Apache-2.0
#include "repository/repository.h"

#include <algorithm>
#include <chrono>

namespace brdf::service {
namespace {

/// Whether a file that carries this stamp could still be rewritten without changing it: the clock of file systems moves in
/// steps, of two seconds on the coarsest.
bool is_settled(const FileStamp& stamp) noexcept {
  const auto now = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  return now - std::max(stamp.modified_ns, stamp.changed_ns) > 2'500'000'000;
}

}  // namespace

RepositoryMode repository_mode(std::string_view name) {
  return name == "none" ? RepositoryMode::none : name == "explicit" ? RepositoryMode::manual : RepositoryMode::poll;
}

Repository::Repository(std::filesystem::path path, RepositoryMode mode, RepositoryLimits limits)
    : folder_(std::move(path)), mode_(mode), limits_(limits) {}

void Repository::require_manual() const {
  if (mode_ != RepositoryMode::manual) throw Error(ErrorCode::invalid_argument, "repository_mode is not explicit: the folder says what is loaded");
}

void Repository::require_room(const Catalogue& catalogue, const std::string& id) const {
  if (catalogue.find(id) || catalogue.materials().size() < limits_.max_materials) return;
  throw Error(ErrorCode::limit_exceeded, "max_materials is " + std::to_string(limits_.max_materials));
}

VersionHandle Repository::read_version(const std::string& id, Seen& seen) const {
  seen.refused.clear();
  RepositoryFolder::Content content = folder_.read(id, limits_.decode.max_file_bytes);
  seen.stamp = content.stamp;
  seen.settled = is_settled(content.stamp);
  return verify_version(id, std::move(content.bytes));
}

void Repository::swap(std::vector<VersionHandle> sorted) {
  const CatalogueHandle before = current_.get(), after = std::make_shared<const Catalogue>(std::move(sorted));
  current_.set(after);
  if (listener_) listener_(before, after);
}

PollResult Repository::poll() {
  const std::lock_guard lock(changing_);
  const CatalogueHandle old = current_.get();
  PollResult result;
  std::vector<VersionHandle> next;
  std::map<std::string, Seen, std::less<>> still;
  for (const FolderEntry& entry : folder_.list()) {
    VersionHandle version = old->find(entry.id);
    if (mode_ == RepositoryMode::manual && !version) continue;
    if (!version && next.size() >= limits_.max_materials) {
      result.refused.push_back({entry.id, "max_materials is " + std::to_string(limits_.max_materials)});
      continue;
    }
    const auto known = seen_.find(entry.id);
    Seen seen = known == seen_.end() ? Seen{} : known->second;
    if (known == seen_.end() || !seen.settled || seen.stamp != entry.stamp) {
      try {
        VersionHandle fresh = read_version(entry.id, seen);
        if (!version || version->version != fresh->version) version = std::move(fresh);
      } catch (const std::exception& e) {  // std::bad_alloc of one file must not cost the others
        seen.refused = e.what();
        seen.stamp = entry.stamp;
        seen.settled = is_settled(entry.stamp);
      }
    }
    if (!seen.refused.empty()) result.refused.push_back({entry.id, seen.refused});
    if (version) next.push_back(std::move(version));
    still.emplace(entry.id, std::move(seen));
  }
  seen_.swap(still);
  result.materials = static_cast<std::uint32_t>(next.size());
  const std::vector<CatalogueChange> changes = changes_between(*old, Catalogue(next));
  for (const CatalogueChange& c : changes) {
    ++(c.type == ChangeType::added ? result.added : c.type == ChangeType::replaced ? result.replaced : result.removed);
  }
  if (!changes.empty()) swap(std::move(next));
  return result;
}

void Repository::replace_one(const std::string& id, VersionHandle version) {
  std::vector<VersionHandle> next = current_.get()->materials();
  const auto at = std::lower_bound(next.begin(), next.end(), id, [](const VersionHandle& m, const std::string& name) { return m->id < name; });
  const bool there = at != next.end() && (*at)->id == id;
  if (!version) {
    if (there) next.erase(at);
  } else if (there) {
    *at = std::move(version);
  } else {
    next.insert(at, std::move(version));
  }
  swap(std::move(next));
}

VersionHandle Repository::load(const std::string& id) {
  require_manual();
  const std::lock_guard lock(changing_);
  const CatalogueHandle old = current_.get();
  require_room(*old, id);
  Seen seen;
  const VersionHandle version = read_version(id, seen);
  seen_[id] = seen;
  const VersionHandle present = old->find(id);
  if (!present || present->version != version->version) replace_one(id, version);
  return version;
}

bool Repository::unload(const std::string& id) {
  require_manual();
  const std::lock_guard lock(changing_);
  if (!current_.get()->find(id)) return false;
  seen_.erase(id);
  replace_one(id, nullptr);
  return true;
}

VersionHandle Repository::publish(const std::string& id, std::vector<std::byte> bytes, bool overwrite) {
  VersionHandle version = verify_version(id, std::move(bytes));
  const std::lock_guard lock(changing_);
  require_room(*current_.get(), id);
  folder_.write(id, version->bytes, overwrite);
  seen_.erase(id);  // the next look reads it again and finds the same version
  replace_one(id, version);
  return version;
}

}  // namespace brdf::service
