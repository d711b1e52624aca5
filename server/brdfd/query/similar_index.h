// SPDX-License-Identifier: Apache-2.0
// Nearest materials by descriptor.
#pragma once

#include "query/descriptor.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace brdf::service {

struct Neighbour {
  std::size_t index = 0;
  double distance = 0;  ///< root mean square over the numbers of the descriptor
};

/// An exact k-d tree (FLANN). Immutable and thread-safe.
class SimilarIndex {
 public:
  explicit SimilarIndex(std::vector<Descriptor> descriptors);
  ~SimilarIndex();

  /// The nearest first, at most `count`; equal ones by index.
  std::vector<Neighbour> nearest(const Descriptor& wanted, std::size_t count) const;

 private:
  struct Tree;
  std::vector<Descriptor> descriptors_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace brdf::service
