// SPDX-License-Identifier: Apache-2.0
// Owner of the three planes that batches of directions travel in.
#pragma once

#include <brdf/direction.h>

#include <span>
#include <vector>

namespace brdf::cli {

class DirectionPlanes {
 public:
  DirectionPlanes() = default;
  explicit DirectionPlanes(std::size_t size) { resize(size); }

  void resize(std::size_t size) {
    x_.resize(size);
    y_.resize(size);
    z_.resize(size);
  }
  std::size_t size() const noexcept { return x_.size(); }

  void set(std::size_t i, const Vec3f& w) noexcept {
    x_[i] = w.x;
    y_[i] = w.y;
    z_[i] = w.z;
  }
  Vec3f get(std::size_t i) const noexcept { return {x_[i], y_[i], z_[i]}; }

  void assign(std::span<const Vec3f> directions) {
    resize(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) set(i, directions[i]);
  }

  DirectionSpan span() const noexcept { return {x_.data(), y_.data(), z_.data(), x_.size()}; }
  MutableDirectionSpan span() noexcept { return {x_.data(), y_.data(), z_.data(), x_.size()}; }

 private:
  std::vector<float> x_, y_, z_;
};

}  // namespace brdf::cli
