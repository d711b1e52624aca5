// SPDX-License-Identifier: Apache-2.0
// Trilinear look-up of the residual ratio for a vector of pairs. Coordinates are computed for all pairs at once, as in
// eval/scalar_grid.h; the table is then read pair by pair in whole rows of adjacent halves. One 16-byte load brings what
// several element gathers would, and gathers are slow where Gather Data Sampling is mitigated.
#include "eval/tables.h"
#include "residual/grid_coordinates.h"

#include "eval/lobe_kernel-inl.h"
#include "eval/eight_floats-inl.h"

#if defined(BRDF_EVAL_GRID_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_GRID_KERNEL_INL_H_
#undef BRDF_EVAL_GRID_KERNEL_INL_H_
#else
#define BRDF_EVAL_GRID_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

/// For each pair: index of the lower corner node, weights of the four (h, d) rows (they hold the power of two that
/// completes the decoding of halves), and the fraction along p.
struct GridRows {
  HWY_ALIGN std::int32_t node[block_pairs];
  HWY_ALIGN float weight[4][block_pairs];
  HWY_ALIGN float fraction_p[block_pairs];
};

struct AxisPosition {
  V lower, fraction;
};

HWY_INLINE AxisPosition axis_position(V x, float last) {
  const V lower = hn::Floor(hn::Min(x, set(last)));
  return {lower, hn::Min(hn::Sub(x, lower), set(1.0f))};
}

/// x on a warped axis
HWY_INLINE V warped(V t, const GridParams::Axis& axis) {
  return quotient(hn::Mul(t, hn::MulAdd(t, set(axis.square), set(axis.linear))), hn::Add(t, set(axis.kappa)));
}

/// Fills one vector of rows, from pair `at` of the block on.
HWY_INLINE void grid_rows(const GridParams& g, const PairVectors& p, GridRows& rows, std::size_t at) {
  const Floats d;
  const V d2 = hn::MulAdd(p.d_z, p.d_z, p.d_xy2);
  const V t_h = root(quotient(p.s_xy2, hn::Mul(p.s, hn::Add(p.s, p.s_z))));
  const V t_d = root(quotient(d2, hn::Mul(p.norm, hn::Add(p.norm, p.s))));
  const V along = hn::Mul(p.d_z, p.s), across2 = hn::MulAdd(p.cross, p.cross, set(min_denominator));
  const V r = root(hn::MulAdd(along, along, across2));
  const V q = root(quotient(across2, hn::Mul(r, hn::Add(r, along))));
  V u_p = q;
  if (g.azimuth != residual::Azimuth::symmetric) {
    // a product, not two signs: with both directions at one height it is 0 either way round
    V side = hn::Sub(p.cos_o, p.cos_i);
    if (g.azimuth == residual::Azimuth::reciprocal) side = hn::Mul(side, p.cross);
    const V half = hn::Mul(q, set(0.5f));
    u_p = hn::IfThenElse(hn::Ge(side, hn::Zero(d)), half, hn::Sub(set(1.0f), half));
  }
  const AxisPosition at_h = axis_position(warped(t_h, g.axis_h), g.last_h);
  const AxisPosition at_d = axis_position(warped(t_d, g.axis_d), g.last_d);
  const AxisPosition at_p = axis_position(hn::Mul(u_p, set(g.scale_p)), g.last_p);

  // masked, because a pair that is not valid may be no number and must not lead out of the table
  const V node = hn::IfThenElseZero(
      p.valid, hn::MulAdd(hn::MulAdd(at_h.lower, set(g.nodes_d), at_d.lower), set(g.nodes_p), at_p.lower));
  hn::Store(hn::ConvertTo(Ints(), node), Ints(), rows.node + at);
  hn::Store(at_p.fraction, d, rows.fraction_p + at);
  const V scale = set(row_scale);
  const V h1 = hn::Mul(at_h.fraction, scale), h0 = hn::Sub(scale, h1);
  const V w1 = hn::Mul(h0, at_d.fraction), w3 = hn::Mul(h1, at_d.fraction);
  hn::Store(hn::Sub(h0, w1), d, rows.weight[0] + at);
  hn::Store(w1, d, rows.weight[1] + at);
  hn::Store(hn::Sub(h1, w3), d, rows.weight[2] + at);
  hn::Store(w3, d, rows.weight[3] + at);
}

/// Where the four (h, d) rows of node 0 start.
struct CornerRows {
  const std::uint16_t* row[4];
  HWY_INLINE explicit CornerRows(const GridParams& g)
      : row{g.ratio, g.ratio + g.step_d, g.ratio + g.step_h, g.ratio + g.step_h + g.step_d} {}
};

/// The rows of pair `i`, from a half of its node on: offset = node_halves node + first.
HWY_INLINE EightFloats rows_of_pair(const CornerRows& corner, const GridRows& rows, std::size_t i, std::ptrdiff_t offset) {
  return weighted_rows(corner.row, offset, rows.weight[0] + i, block_pairs);
}

/// max(0, (lobes + epsilon) ratio - epsilon)
HWY_INLINE V with_ratio(V lobes, V ratio, V epsilon) {
  return hn::Max(hn::MulSub(hn::Add(lobes, epsilon), ratio, epsilon), hn::Zero(Floats()));
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
