// SPDX-License-Identifier: Apache-2.0
// Queries of a path under way, whose contributions come to light only at its end.
#pragma once

#include "image/luminance.h"
#include "path/path_observer.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace brdf::render {

class QueryLog {
 public:
  /// `radiance_before`: what the path had gathered when it went on from here; what comes later passes through this pair.
  void add(const MaterialQuery& query, const Vec3f& radiance_before) noexcept {
    if (size_ < entries_.size()) entries_[size_++] = {query, luminance(radiance_before)};
  }
  void report(const Vec3f& radiance, PathObserver& observer) noexcept {
    const float whole = luminance(radiance);
    for (std::size_t i = 0; i < size_; ++i) {
      Entry& e = entries_[i];
      if ((e.query.operations & query_sample) != 0) e.query.contribution = std::max(0.0f, whole - e.before);
      observer.query(e.query);
    }
  }

 private:
  struct Entry {
    MaterialQuery query;
    float before = 0;
  };
  std::array<Entry, 256> entries_;
  std::size_t size_ = 0;
};

}  // namespace brdf::render
