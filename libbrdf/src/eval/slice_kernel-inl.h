// SPDX-License-Identifier: Apache-2.0
// f of a block of pairs from a table in slices, as slices/slice_map.h defines it. Angles come from half-angle sines by one
// polynomial; positions are computed for all pairs at once, the tables are read pair by pair in whole rows.
#include "eval/tables.h"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "eval/lobe_kernel-inl.h"

#if defined(BRDF_EVAL_SLICE_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_SLICE_KERNEL_INL_H_
#undef BRDF_EVAL_SLICE_KERNEL_INL_H_
#else
#define BRDF_EVAL_SLICE_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

/// asin(sqrt(z)) for z in [0, 1/2]: a polynomial through the Chebyshev nodes, error below 1e-7.
HWY_INLINE V arcsine_of_root(V z) {
  constexpr float c[] = {0.9999999868f,  0.1666699324f,  0.07486847096f,  0.04663621562f,
                         0.01582790451f, 0.07822891898f, -0.09404627596f, 0.1119608986f};
  V p = set(c[7]);
  for (int k = 6; k >= 0; --k) p = hn::MulAdd(p, z, set(c[k]));
  return hn::Mul(hn::Sqrt(z), p);
}

/// What a block of pairs keeps between the passes.
struct SliceBlock {
  HWY_ALIGN std::int32_t slice[block_pairs], sample[block_pairs], row[block_pairs], ndf[block_pairs], sigma[block_pairs];
  HWY_ALIGN float to_slice[block_pairs], to_row[block_pairs], to_column[block_pairs], to_sigma[block_pairs];
  HWY_ALIGN float beyond[block_pairs];                                      ///< the last folded row, in rows
  HWY_ALIGN float density[4 * block_pairs], rows[4 * block_pairs], shape[4 * block_pairs];
  HWY_ALIGN std::int32_t node[block_pairs];
  HWY_ALIGN float to_u[block_pairs], to_v[block_pairs], scale[block_pairs];
  HWY_ALIGN float value[4 * block_pairs];
};

struct CellPosition {
  VI index;
  V fraction;
};

/// Cell of x >= 0 among `last` + 1 cells.
HWY_INLINE CellPosition cell_position(V x, int last) {
  const VI index = hn::ConvertTo(Ints(), hn::Min(x, set(static_cast<float>(last))));
  return {index, hn::Min(hn::Sub(x, hn::ConvertTo(Floats(), index)), set(1.0f))};
}

/// First pass, one vector of pairs of unit vectors: positions in the tables of the map.
HWY_INLINE void begin_slices(const slices::SliceView& t, const Directions& wi, const Directions& wo, SliceBlock& b, std::size_t at) {
  const Floats d;
  const Ints di;
  const V tiny = set(1e-36f), zero = hn::Zero(d);
  const V hx = hn::Add(wi.x, wo.x), hy = hn::Add(wi.y, wo.y), hz = hn::Add(wi.z, wo.z);
  const V rho_i2 = hn::MulAdd(wi.x, wi.x, hn::Mul(wi.y, wi.y)), rho_h2 = hn::MulAdd(hx, hx, hn::Mul(hy, hy));
  const V length = hn::Sqrt(hn::MulAdd(hz, hz, rho_h2));
  // sin^2(theta / 2) = rho^2 / (2 r (r + z)), at most 1/2 above the horizon
  const V half = set(0.5f);
  const auto half_sine2 = [&](V rho2, V r, V z) HWY_ATTR {
    return hn::Min(hn::Div(hn::Mul(rho2, half), hn::Max(hn::Mul(r, hn::Add(r, z)), tiny)), half);
  };
  const V radius_i = hn::Sqrt(hn::MulAdd(wi.z, wi.z, rho_i2));
  const V theta_i = hn::Add(arcsine_of_root(half_sine2(rho_i2, radius_i, wi.z)), arcsine_of_root(half_sine2(rho_i2, radius_i, wi.z)));
  const V theta_h_half = arcsine_of_root(half_sine2(rho_h2, length, hz));
  const V along = hn::MulAdd(wi.x, hx, hn::Mul(wi.y, hy)), across = hn::MulSub(wi.x, hy, hn::Mul(wi.y, hx));
  const V across2 = hn::Mul(across, across), r = hn::Sqrt(hn::MulAdd(along, along, across2));
  const V turn = hn::Mul(arcsine_of_root(half_sine2(across2, r, hn::Abs(along))), set(std::numbers::inv_pi_v<float>));
  const V v_h = hn::IfThenElse(hn::Ge(along, zero), hn::Sub(half, turn), turn);

  VI slice = hn::Zero(di);
  V node = set(t.theta_i[0]), per_radian = set(t.per_radian[0]);
  for (int k = 1; k + 1 < t.slices; ++k) {
    const auto above = hn::Ge(theta_i, set(t.theta_i[k]));
    slice = hn::IfThenElse(hn::RebindMask(di, above), hn::Set(di, k), slice);
    node = hn::IfThenElse(above, set(t.theta_i[k]), node);
    per_radian = hn::IfThenElse(above, set(t.per_radian[k]), per_radian);
  }
  const V to_slice = hn::Min(hn::Max(hn::Mul(hn::Sub(theta_i, node), per_radian), zero), set(1.0f));

  constexpr float four_over_pi = 4 * std::numbers::inv_pi_v<float>;
  const CellPosition column = cell_position(hn::Mul(hn::Sqrt(hn::Mul(theta_h_half, set(four_over_pi))), set(static_cast<float>(t.columns - 1))), t.columns - 2);
  const V y = hn::Mul(v_h, set(static_cast<float>(t.all_rows - 1))), last_row = set(static_cast<float>(t.rows - 1));
  const CellPosition row = cell_position(hn::Min(y, last_row), t.rows - 2);
  const CellPosition sigma =
      cell_position(hn::Mul(hn::Sqrt(hn::Mul(theta_i, set(0.5f * four_over_pi))), set(static_cast<float>(t.sigma_nodes - 1))), t.sigma_nodes - 2);
  const VI rows = hn::Add(hn::Mul(slice, hn::Set(di, t.rows)), row.index);
  hn::Store(slice, di, b.slice + at);
  hn::Store(rows, di, b.row + at);
  hn::Store(hn::Add(hn::Mul(rows, hn::Set(di, t.columns)), column.index), di, b.sample + at);
  hn::Store(column.index, di, b.ndf + at);
  hn::Store(sigma.index, di, b.sigma + at);
  hn::Store(to_slice, d, b.to_slice + at);
  hn::Store(row.fraction, d, b.to_row + at);
  hn::Store(column.fraction, d, b.to_column + at);
  hn::Store(sigma.fraction, d, b.to_sigma + at);
  hn::Store(hn::Max(hn::Sub(y, last_row), zero), d, b.beyond + at);
  hn::Store(wo.z, d, b.scale + at);
}

/// Four floats of a table: a vector of the compiler (gcc, clang), whatever the instruction set.
typedef float Float4 __attribute__((vector_size(16)));

HWY_INLINE Float4 load_four(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

HWY_INLINE void store_four(const Float4& v, float* HWY_RESTRICT p) { std::memcpy(p, &v, sizeof v); }

/// Second pass, pair by pair: what the map holds around each of the first `size` pairs.
HWY_INLINE void read_map(const slices::SliceView& t, std::size_t size, SliceBlock& b) {
  const std::ptrdiff_t next_row = 2 * static_cast<std::ptrdiff_t>(t.columns), next_slice = next_row * t.rows;
  for (std::size_t i = 0; i < size; ++i) {
    const float s1 = b.to_slice[i], s0 = 1 - s1, y1 = b.to_row[i], y0 = 1 - y1;
    const float* p = t.density + 2 * static_cast<std::ptrdiff_t>(b.sample[i]);
    store_four(s0 * (y0 * load_four(p) + y1 * load_four(p + next_row)) +
                   s1 * (y0 * load_four(p + next_slice) + y1 * load_four(p + next_slice + next_row)),
               b.density + 4 * i);
    const float* q = t.row + 2 * static_cast<std::ptrdiff_t>(b.row[i]);
    store_four(s0 * load_four(q) + s1 * load_four(q + 2 * static_cast<std::ptrdiff_t>(t.rows)), b.rows + 4 * i);
    std::memcpy(b.shape + 4 * i, t.ndf + b.ndf[i], 2 * sizeof(float));
    std::memcpy(b.shape + 4 * i + 2, t.sigma + b.sigma[i], 2 * sizeof(float));
  }
}

/// Third pass, one vector: position in the table of values, and the factor that makes f of them.
HWY_INLINE void place_values(const slices::SliceView& t, SliceBlock& b, std::size_t at) {
  const Floats d;
  const Ints di;
  const V zero = hn::Zero(d), half = set(0.5f);
  V left, along_row, right, unused, below, before, upper, unused_too, ndf0, ndf1, sigma0, sigma1;
  hn::LoadInterleaved4(d, b.density + 4 * at, left, along_row, right, unused);
  hn::LoadInterleaved4(d, b.rows + 4 * at, below, before, upper, unused_too);
  hn::LoadInterleaved4(d, b.shape + 4 * at, ndf0, ndf1, sigma0, sigma1);
  const V fx = hn::Load(d, b.to_column + at), fy = hn::Load(d, b.to_row + at), fs = hn::Load(d, b.to_sigma + at);
  // integrals of a line from the left end of its cell
  const auto integral = [&](V a, V e, V f) HWY_ATTR { return hn::Mul(f, hn::MulAdd(hn::Mul(half, f), hn::Sub(e, a), a)); };
  const V total = hn::MulAdd(fy, hn::Sub(upper, below), below);
  const V u = hn::IfThenElseZero(hn::Gt(total, zero), hn::Div(hn::Add(along_row, integral(left, right, fx)), total));
  const V v = hn::MulAdd(hn::Load(d, b.beyond + at), upper, hn::Add(before, integral(below, upper, fy)));
  const V ndf = hn::MulAdd(fx, hn::Sub(ndf1, ndf0), ndf0), sigma = hn::MulAdd(fs, hn::Sub(sigma1, sigma0), sigma0);
  const V cos_o = hn::Max(hn::Load(d, b.scale + at), set(1e-9f));
  hn::Store(hn::Div(ndf, hn::Mul(hn::Mul(sigma, set(4.0f)), cos_o)), d, b.scale + at);
  const CellPosition x = cell_position(hn::Mul(hn::Min(hn::Max(u, zero), set(1.0f)), set(static_cast<float>(t.width - 1))), t.width - 2);
  const V height = hn::Mul(hn::Min(hn::Max(v, zero), half), set(static_cast<float>(t.height - 1)));
  const CellPosition y = cell_position(hn::Min(height, set(static_cast<float>(t.half_height - 1))), std::max(t.half_height - 2, 0));
  const VI row = hn::Add(hn::Mul(hn::Load(di, b.slice + at), hn::Set(di, t.half_height)), y.index);
  hn::Store(hn::Add(hn::Mul(row, hn::Set(di, t.width)), x.index), di, b.node + at);
  hn::Store(x.fraction, d, b.to_u + at);
  hn::Store(y.fraction, d, b.to_v + at);
}

/// Fourth pass, pair by pair: up to four channels from `channel` on, not yet scaled.
HWY_INLINE void read_values(const slices::SliceView& t, std::size_t size, std::ptrdiff_t channel, SliceBlock& b) {
  const std::ptrdiff_t u = t.channels, v = t.half_height > 1 ? t.width * u : 0;
  const std::ptrdiff_t slice = static_cast<std::ptrdiff_t>(t.half_height) * t.width * u;
  for (std::size_t i = 0; i < size; ++i) {
    const float* p = t.values + b.node[i] * u + channel;
    const float s1 = b.to_slice[i], s0 = 1 - s1, v1 = b.to_v[i], v0 = 1 - v1;
    const Float4 below = s0 * (v0 * load_four(p) + v1 * load_four(p + v)) + s1 * (v0 * load_four(p + slice) + v1 * load_four(p + slice + v));
    p += u;
    const Float4 above = s0 * (v0 * load_four(p) + v1 * load_four(p + v)) + s1 * (v0 * load_four(p + slice) + v1 * load_four(p + slice + v));
    store_four(below + b.to_u[i] * (above - below), b.value + 4 * i);
  }
}

/// f of `size` pairs, whose first pass is done, times `factor` (negative: f = 0).
HWY_INLINE void finish_slices(const slices::SliceView& t, SliceBlock& b, const float* HWY_RESTRICT factor, std::size_t size,
                              const PlanarSpan& f, std::size_t first) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d), vectors = (size + lanes - 1) / lanes * lanes;
  for (std::size_t i = 4 * size; i < 4 * vectors; ++i) b.density[i] = b.rows[i] = b.shape[i] = b.value[i] = 0;
  read_map(t, size, b);
  for (std::size_t at = 0; at < vectors; at += lanes) place_values(t, b, at);
  for (std::size_t channel = 0; channel < static_cast<std::size_t>(t.channels); channel += 4) {
    read_values(t, size, static_cast<std::ptrdiff_t>(channel), b);
    for (std::size_t at = 0; at < vectors; at += lanes) {
      V value[4];
      hn::LoadInterleaved4(d, b.value + 4 * at, value[0], value[1], value[2], value[3]);
      const V scale = hn::Mul(hn::Load(d, b.scale + at), hn::Max(hn::Load(d, factor + at), hn::Zero(d)));
      for (std::size_t c = channel; c < std::min(channel + 4, static_cast<std::size_t>(t.channels)); ++c)
        store_first(hn::Min(hn::Mul(scale, value[c - channel]), set(slices::largest_value)), f.data + c * f.stride + first + at, std::min(lanes, size - at));
    }
  }
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
