// SPDX-License-Identifier: Apache-2.0
// What a component's density follows: the mean over the channels of f cos_i, or of a part of it.
#pragma once

#include "eval/tables.h"
#include "sample/half_vector_map.h"

#include <brdf/direction.h>

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::sample {

class Integrand {
 public:
  /// A term of f; `turned`: with the view turned by pi about the normal.
  struct Part {
    const eval::Tables* tables;
    double sign;
    bool turned;
  };

  /// The sum of `parts`, which must outlive this. One that is not `mirror_symmetric` counts as the mean of both sides.
  Integrand(std::vector<Part> parts, bool mirror_symmetric) : parts_(std::move(parts)), both_sides_(!mirror_symmetric) {}

  /// At directions wi for the view (s, 0, c) of `map`; 0 where it is negative or not finite.
  void evaluate(const HalfVectorMap<double>& map, std::span<const Vec3d> wi, std::span<double> f_cos);

 private:
  void add(const Part& part, const HalfVectorMap<double>& map, std::span<const Vec3d> wi, double side, std::span<double> f_cos);

  std::vector<Part> parts_;
  bool both_sides_;
  std::vector<float> planes_[6], f_;
};

}  // namespace brdf::sample
