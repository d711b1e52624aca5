// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encode/dense_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "encode/dense_kernels.h"

#include <hwy/highway.h>

#include <algorithm>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace brdf::encode::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;

void scaled_sum(double* HWY_RESTRICT out, const double* HWY_RESTRICT in, double factor, std::size_t n) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  const auto f = hn::Set(d, factor);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    hn::StoreU(hn::Add(hn::LoadU(d, out + i), hn::Mul(f, hn::LoadU(d, in + i))), d, out + i);
  for (; i < n; ++i) out[i] += factor * in[i];
}

constexpr std::size_t tile_rows = 4, tile_vectors = 2;
constexpr std::size_t depth = 128;  // rows at a time: a packed panel stays in the first cache

/// tile[r][j] += sum over p of left[p][r] * right[p][j], p ascending; `stride` is that of the tile's rows.
void add_tile(double* HWY_RESTRICT tile, std::size_t stride, const double* HWY_RESTRICT left, const double* HWY_RESTRICT right,
              std::size_t count) {
  const Doubles d;
  const std::size_t lanes = hn::Lanes(d);
  auto a0 = hn::LoadU(d, tile), b0 = hn::LoadU(d, tile + lanes);
  auto a1 = hn::LoadU(d, tile + stride), b1 = hn::LoadU(d, tile + stride + lanes);
  auto a2 = hn::LoadU(d, tile + 2 * stride), b2 = hn::LoadU(d, tile + 2 * stride + lanes);
  auto a3 = hn::LoadU(d, tile + 3 * stride), b3 = hn::LoadU(d, tile + 3 * stride + lanes);
  for (std::size_t p = 0; p < count; ++p, left += tile_rows, right += tile_vectors * lanes) {
    const auto x = hn::LoadU(d, right), y = hn::LoadU(d, right + lanes);
    const auto l0 = hn::Set(d, left[0]), l1 = hn::Set(d, left[1]), l2 = hn::Set(d, left[2]), l3 = hn::Set(d, left[3]);
    a0 = hn::Add(a0, hn::Mul(l0, x));
    b0 = hn::Add(b0, hn::Mul(l0, y));
    a1 = hn::Add(a1, hn::Mul(l1, x));
    b1 = hn::Add(b1, hn::Mul(l1, y));
    a2 = hn::Add(a2, hn::Mul(l2, x));
    b2 = hn::Add(b2, hn::Mul(l2, y));
    a3 = hn::Add(a3, hn::Mul(l3, x));
    b3 = hn::Add(b3, hn::Mul(l3, y));
  }
  hn::StoreU(a0, d, tile);
  hn::StoreU(b0, d, tile + lanes);
  hn::StoreU(a1, d, tile + stride);
  hn::StoreU(b1, d, tile + stride + lanes);
  hn::StoreU(a2, d, tile + 2 * stride);
  hn::StoreU(b2, d, tile + 2 * stride + lanes);
  hn::StoreU(a3, d, tile + 3 * stride);
  hn::StoreU(b3, d, tile + 3 * stride + lanes);
}

void outer_products(double* gram, std::size_t n, const double* rows, std::size_t count, double scale) {
  const std::size_t width = tile_vectors * hn::Lanes(Doubles());
  const std::size_t panels = (n + width - 1) / width, strips = (n + tile_rows - 1) / tile_rows;
  std::vector<double> right(panels * width * depth), left(strips * tile_rows * depth), edge(tile_rows * width);
  for (std::size_t first = 0; first < count; first += depth) {
    const std::size_t used = std::min(depth, count - first);
    for (std::size_t p = 0; p < used; ++p) {
      const double* row = rows + (first + p) * n;
      for (std::size_t j = 0; j < panels * width; ++j) right[(j / width * used + p) * width + j % width] = j < n ? row[j] : 0.0;
      for (std::size_t i = 0; i < strips * tile_rows; ++i)
        left[(i / tile_rows * used + p) * tile_rows + i % tile_rows] = i < n ? scale * row[i] : 0.0;
    }
    for (std::size_t panel = 0; panel < panels; ++panel) {
      const std::size_t j = panel * width;
      const double* packed = right.data() + panel * used * width;
      for (std::size_t i = 0; i < std::min(n, j + width); i += tile_rows) {  // at and above the diagonal
        const double* strip = left.data() + i * used;
        double* tile = gram + i * n + j;
        if (i + tile_rows <= n && j + width <= n) {
          add_tile(tile, n, strip, packed, used);
          continue;
        }
        const std::size_t high = std::min(tile_rows, n - i), wide = std::min(width, n - j);
        for (std::size_t r = 0; r < high; ++r) std::copy_n(tile + r * n, wide, edge.data() + r * width);
        add_tile(edge.data(), width, strip, packed, used);
        for (std::size_t r = 0; r < high; ++r) std::copy_n(edge.data() + r * width, wide, tile + r * n);
      }
    }
  }
}

}  // namespace brdf::encode::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::encode {
namespace {

HWY_EXPORT(scaled_sum);
HWY_EXPORT(outer_products);

}  // namespace

void add_scaled(double* out, const double* in, double factor, std::size_t n) { HWY_DYNAMIC_DISPATCH(scaled_sum)(out, in, factor, n); }

void add_outer_products(double* gram, std::size_t n, const double* rows, std::size_t count, double scale) {
  HWY_DYNAMIC_DISPATCH(outer_products)(gram, n, rows, count, scale);
  // tiles on the diagonal reach below it by an amount that depends on their width: the upper triangle is what counts
  constexpr std::size_t block = 32;
  for (std::size_t i0 = 0; i0 < n; i0 += block)
    for (std::size_t j0 = i0; j0 < n; j0 += block)
      for (std::size_t i = i0; i < std::min(i0 + block, n); ++i)
        for (std::size_t j = std::max(j0, i + 1); j < std::min(j0 + block, n); ++j) gram[j * n + i] = gram[i * n + j];
}

}  // namespace brdf::encode
#endif
