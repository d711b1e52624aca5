// SPDX-License-Identifier: Apache-2.0
// Directional albedo at the fixed angles.
#pragma once

#include "metrics/queries.h"

#include <span>

namespace brdf::metrics {

/// Albedo of channel c at angle k: value[k * channels + c].
struct Albedos {
  int channels = 0;
  std::vector<double> value;

  explicit Albedos(int channel_count)
      : channels(channel_count), value(albedo_cosines.size() * static_cast<std::size_t>(channel_count), 0.0) {}

  /// Adds rows [first, first + count) of one angle; different angles may be added from different threads at once.
  void add(const QuerySet& set, std::size_t first, std::size_t count, std::span<const float> f) noexcept;

  /// Largest difference over angles and channels.
  double largest_difference(const Albedos& other) const noexcept;
};

}  // namespace brdf::metrics
