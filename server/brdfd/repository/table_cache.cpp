// SPDX-License-Identifier: Apache-2.0
#include "repository/table_cache.h"

#include <span>

namespace brdf::service {
namespace {

Material build(const MaterialVersion& version, EvalLevel level, std::uint64_t bytes, bool sampling, const DecodeLimits& limits) {
  DecodeOptions options;
  options.limits = limits;
  options.level = level;
  options.sampling = sampling;
  options.allow_prefix = bytes < version.bytes.size();
  return Material::decode(std::span(version.bytes).first(static_cast<std::size_t>(bytes)), options);
}

}  // namespace

Material TableCache::get(const VersionHandle& version, EvalLevel level, std::uint64_t bytes, bool sampling) {
  const Key key{version->version, level, bytes, sampling};
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto [at, is_new] = entries_.try_emplace(key);
    if (is_new) break;
    if (at->second.material) {
      order_.splice(order_.begin(), order_, at->second.used);
      return *at->second.material;
    }
    built_one_.wait(lock);  // another thread builds it; if it fails, the entry is gone and this thread finds out itself
  }
  lock.unlock();
  std::optional<Material> material;
  std::list<Key> used;  // before it is built: nothing may fail after
  try {
    used.push_front(key);
    material = build(*version, level, bytes, sampling, limits_);
  } catch (...) {
    lock.lock();
    entries_.erase(key);
    built_one_.notify_all();
    throw;
  }
  lock.lock();
  order_.splice(order_.begin(), used);
  Entry& entry = entries_[key];
  entry.material = material;
  entry.used = order_.begin();
  entry.bytes = material->resident_bytes() + material->sampling_bytes();
  bytes_ += entry.bytes;
  ++built_;
  drop_to_budget(key);
  built_one_.notify_all();
  return *material;
}

std::optional<Material> TableCache::find(const MaterialVersion& version, EvalLevel level, std::uint64_t bytes, bool sampling) {
  const std::lock_guard lock(mutex_);
  const auto at = entries_.find(Key{version.version, level, bytes, sampling});
  if (at == entries_.end() || !at->second.material) return std::nullopt;
  order_.splice(order_.begin(), order_, at->second.used);
  return at->second.material;
}

void TableCache::drop_to_budget(const Key& keep) {
  while (bytes_ > budget_ && !order_.empty() && order_.back() != keep) {
    const auto oldest = entries_.find(order_.back());
    bytes_ -= oldest->second.bytes;
    entries_.erase(oldest);
    order_.pop_back();
    ++dropped_;
  }
}

std::uint64_t TableCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::uint64_t TableCache::built() const {
  const std::lock_guard lock(mutex_);
  return built_;
}

std::uint64_t TableCache::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace brdf::service
