// SPDX-License-Identifier: Apache-2.0
#include "query/similar_index.h"

#include <flann/flann.hpp>

#include <algorithm>
#include <cmath>

namespace brdf::service {

struct SimilarIndex::Tree {
  explicit Tree(const flann::Matrix<float>& points) : index(points, flann::KDTreeSingleIndexParams(10, false)) { index.buildIndex(); }
  flann::KDTreeSingleIndex<flann::L2<float>> index;
};

SimilarIndex::SimilarIndex(std::vector<Descriptor> descriptors) : descriptors_(std::move(descriptors)) {
  if (descriptors_.empty()) return;
  tree_ = std::make_unique<Tree>(flann::Matrix<float>(descriptors_.front().data(), descriptors_.size(), descriptor_size));
}

SimilarIndex::~SimilarIndex() = default;

std::vector<Neighbour> SimilarIndex::nearest(const Descriptor& wanted, std::size_t count) const {
  count = std::min(count, descriptors_.size());
  if (count == 0) return {};
  Descriptor query = wanted;  // FLANN takes no pointer to const
  std::vector<std::size_t> index(count);
  std::vector<float> squared(count);
  flann::Matrix<std::size_t> found(index.data(), 1, count);
  flann::Matrix<float> distance(squared.data(), 1, count);
  tree_->index.knnSearch(flann::Matrix<float>(query.data(), 1, descriptor_size), found, distance, count, flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
  std::vector<Neighbour> near;
  for (std::size_t i = 0; i < count; ++i) near.push_back({index[i], std::sqrt(static_cast<double>(squared[i]) / descriptor_size)});
  std::sort(near.begin(), near.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
  });
  return near;
}

}  // namespace brdf::service
