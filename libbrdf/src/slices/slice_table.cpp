// SPDX-License-Identifier: Apache-2.0
#include "slices/slice_table.h"

#include "residual/basis.h"
#include "residual/channel_transform.h"
#include "slices/axis_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace brdf::slices {
namespace {

constexpr float largest_exponent = 80.0f;
constexpr std::size_t padding = 8;  // floats behind the values, for vectors
constexpr std::size_t block = 256;  // nodes

std::size_t nodes_of(const residual::SliceFrame& f) noexcept {
  return f.theta_i.size() * static_cast<std::size_t>(f.half_height()) * f.width;
}

}  // namespace

SliceTable::SliceTable(const residual::Coefficients& c)
    : map_(c.slices), width_(c.slices.width), half_height_(static_cast<std::size_t>(c.slices.half_height())), height_(c.slices.height),
      channels_(static_cast<std::size_t>(c.channels)) {
  const std::size_t slices = map_.slices(), nodes = nodes_of(c.slices);
  const std::vector<double> matrix = residual::channel_matrix(c.transform, c.channels);
  const auto epsilon = static_cast<float>(residual::epsilon_of(c.slices.epsilon));
  std::vector<std::vector<float>> transformed;
  for (const std::vector<float>& values : c.values) {
    std::vector<float> cube(nodes, 0.0f);
    for (std::size_t j = 0; j < values.size(); ++j)
      cube[(c.order[j].m * half_height_ + c.order[j].l) * width_ + c.order[j].k] = values[j];
    cube = cosine_sums(cube, 1, slices, half_height_ * width_);
    cube = cosine_sums(cube, slices, half_height_, width_);
    cube = cosine_sums(cube, slices * half_height_, width_, 1);
    cube.resize((nodes + block - 1) / block * block);
    transformed.push_back(std::move(cube));
  }
  for (std::size_t i = 0; i < slices; ++i) theta_i_.push_back(static_cast<float>(map_.theta_i(i)));
  for (std::size_t i = 0; i + 1 < slices; ++i) per_radian_.push_back(static_cast<float>(1 / (map_.theta_i(i + 1) - map_.theta_i(i))));
  per_radian_.push_back(0.0f);
  values_.resize(nodes * channels_ + padding);
  // nodes times the square of the channels, both chosen by the file: block by block, so that what is read stays in a cache
  std::array<float, block> sum;
  for (std::size_t first = 0; first < nodes; first += block)
    for (std::size_t ch = 0; ch < channels_; ++ch) {
      sum.fill(0.0f);
      for (std::size_t t = 0; t < channels_; ++t) {
        const auto weight = static_cast<float>(matrix[t * channels_ + ch]);
        const float* from = transformed[t].data() + first;
        for (std::size_t n = 0; n < block; ++n) sum[n] += weight * from[n];
      }
      for (std::size_t n = 0; n < std::min(block, nodes - first); ++n)
        values_[(first + n) * channels_ + ch] = std::max(std::exp(std::clamp(sum[n], -largest_exponent, largest_exponent)) - epsilon, 0.0f);
    }
}

SliceView SliceTable::view() const noexcept {
  SliceView v;
  v.theta_i = theta_i_.data();
  v.per_radian = per_radian_.data();
  v.density = &map_.samples().front().density;
  v.row = &map_.row_integrals().front().total;
  v.ndf = map_.ndf().data();
  v.sigma = map_.sigma().data();
  v.values = values_.data();
  v.slices = static_cast<int>(map_.slices());
  v.columns = static_cast<int>(map_.columns());
  v.rows = static_cast<int>(map_.rows());
  v.all_rows = static_cast<int>(map_.all_rows());
  v.sigma_nodes = static_cast<int>(map_.sigma().size());
  v.width = static_cast<int>(width_);
  v.height = static_cast<int>(height_);
  v.half_height = static_cast<int>(half_height_);
  v.channels = static_cast<int>(channels_);
  return v;
}

std::size_t SliceTable::bytes() const noexcept {
  return map_.samples().size_bytes() + map_.row_integrals().size_bytes() + map_.ndf().size_bytes() + map_.sigma().size_bytes() +
         (values_.size() + theta_i_.size() + per_radian_.size()) * sizeof(float);
}

std::size_t SliceTable::bytes_of(const residual::SliceFrame& f, int channels) noexcept {
  const std::size_t slices = f.theta_i.size(), rows = slices * ((f.rows + 1U) / 2U), columns = f.ndf.size();
  return rows * columns * sizeof(SliceMap::Sample) + rows * sizeof(SliceMap::Row) +
         (columns + sigma_nodes + nodes_of(f) * static_cast<std::size_t>(channels) + padding + 2 * slices) * sizeof(float);
}

std::size_t SliceTable::temporary_bytes_of(const residual::SliceFrame& f, int channels) noexcept {
  const auto n = static_cast<std::size_t>(channels);
  const std::size_t longest = std::max({f.theta_i.size(), static_cast<std::size_t>(f.half_height()), static_cast<std::size_t>(f.width)});
  // the cosines of all channels and a cube before and after a sum; rows of the map
  return (nodes_of(f) + block) * (n + 3) * sizeof(float) + (longest * longest + longest) * sizeof(float) + n * (n * sizeof(double) + 2 * sizeof(std::vector<float>)) +
         4 * f.ndf.size() * sizeof(double) + 2 * f.theta_i.size() * sizeof(double);
}

void SliceTable::eval(const SliceAngles& at, double cos_o, std::span<float> f) const noexcept {
  const SlicePoint p = map_.point(at, cos_o);
  const float x = p.u * static_cast<float>(width_ - 1);
  const float y = std::min(p.v * static_cast<float>(height_ - 1), static_cast<float>(half_height_ - 1));
  const std::size_t left = std::min(static_cast<std::size_t>(x), width_ - 2);
  const std::size_t low = half_height_ > 1 ? std::min(static_cast<std::size_t>(y), half_height_ - 2) : 0;
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(low);
  const std::size_t row = width_ * channels_, slice = half_height_ * row, up = half_height_ > 1 ? row : 0;
  const float* corner = values_.data() + p.slice * slice + low * row + left * channels_;
  for (std::size_t c = 0; c < f.size(); ++c) {
    const auto square = [&](const float* q) {
      const float below = q[c] + fx * (q[c + channels_] - q[c]), above = q[up + c] + fx * (q[up + c + channels_] - q[up + c]);
      return below + fy * (above - below);
    };
    const float lower = square(corner);
    f[c] = std::min(p.scale * (lower + p.fraction * (square(corner + slice) - lower)), largest_value);
  }
}

}  // namespace brdf::slices
