// SPDX-License-Identifier: Apache-2.0
#include "decode/resample_slices.h"

#include "decode/node_shift.h"
#include "eval/batch_eval.h"
#include "residual/basis.h"
#include "residual/half_float.h"
#include "slices/slice_table.h"

#include <algorithm>
#include <cmath>

namespace brdf::decode {
namespace {

constexpr double smallest_sine = 1e-6;    // a pole's neighbourhood stands for the pole
constexpr float lowest_cosine = 0.012f;   // 89.3 degrees: beyond, 1 / cos theta_o takes over
constexpr float largest_ratio = 14765.0f, smallest_ratio = 1 / largest_ratio;  // normal half floats
constexpr std::size_t most_lobes = 16 + 1;  // of GGX, and the sum of the others
constexpr float steepest = 2.0f;          // quotient of two neighbours across the horizon

struct Angle {
  float sine, cosine;
};

std::vector<Angle> node_angles(int n, double kappa) {
  std::vector<Angle> angles;
  for (int i = 0; i < n; ++i) {
    const double t = residual::unwarp(static_cast<double>(i) / (n - 1), kappa);  // sqrt(1 - cos theta)
    const double cosine = 1 - t * t, sine = std::sqrt(std::max(1 - cosine * cosine, smallest_sine * smallest_sine));
    angles.push_back({static_cast<float>(sine), static_cast<float>(cosine)});
  }
  return angles;
}

/// Pairs of directions in planes.
struct Pairs {
  explicit Pairs(std::size_t most) : planes(6 * most), capacity(most) {}
  std::vector<float> planes;
  std::size_t capacity, size = 0;

  void push(const Vec3f& wi, const Vec3f& wo) noexcept {
    const float w[6] = {wi.x, wi.y, wi.z, wo.x, wo.y, wo.z};
    for (std::size_t k = 0; k < 6; ++k) planes[k * capacity + size] = w[k];
    ++size;
  }
  DirectionSpan directions(std::size_t first) const noexcept {
    const float* p = planes.data() + first * capacity;
    return {p, p + capacity, p + 2 * capacity, size};
  }
};

/// Measurement over lobes for all (p, d) of one theta_h.
class RatioPlane {
 public:
  RatioPlane(const slices::SliceTable& table, const LobeSet& lobes, const residual::GridSize& size, float epsilon)
      : n_d_(static_cast<std::size_t>(size.n_d)), n_p_(static_cast<std::size_t>(size.n_p)), channels_(static_cast<std::size_t>(lobes.channels)),
        epsilon_(epsilon), pairs_(n_d_ * n_p_), measured_(n_d_ * n_p_ * channels_), analytic_(measured_.size()), above_(n_p_) {
    of_lobes_.lobes = eval::LobeParams(lobes);
    of_slices_.lobes.channels = lobes.channels;
    of_slices_.slices = table.view();
  }

  /// [d][p][channel]
  void fill(const Angle& half, const std::vector<Angle>& differences, const std::vector<Angle>& azimuths, float* out) {
    collect(half, differences, azimuths);
    const DirectionSpan wi = pairs_.directions(0), wo = pairs_.directions(3);
    eval::eval_batch(of_slices_, wi, wo, {measured_.data(), pairs_.capacity});
    eval::eval_batch(of_lobes_, wi, wo, {analytic_.data(), pairs_.capacity});
    for (std::size_t c = 0; c < channels_; ++c) {
      const float *f = measured_.data() + c * pairs_.capacity, *l = analytic_.data() + c * pairs_.capacity;
      for (std::size_t p = 0; p < n_p_; f += above_[p], l += above_[p], ++p) line(f, l, above_[p], out + p * channels_ + c);
    }
  }

 private:
  void collect(const Angle& half, const std::vector<Angle>& differences, const std::vector<Angle>& azimuths) {
    pairs_.size = 0;
    for (std::size_t p = 0; p < n_p_; ++p) {
      std::size_t& above = above_[p];  // nodes above the horizon; they come first
      for (above = 0; above < n_d_; ++above) {
        const Angle& difference = differences[above];
        const float x = difference.sine * azimuths[p].cosine, y = difference.sine * azimuths[p].sine;
        const float z = half.cosine * difference.cosine, forward = half.sine * difference.cosine;
        const Vec3f wi{forward + half.cosine * x, y, z - half.sine * x}, wo{forward - half.cosine * x, -y, z + half.sine * x};
        if (std::min(wi.z, wo.z) < lowest_cosine) break;
        pairs_.push(wi, wo);
      }
    }
  }

  /// Ratios along theta_d; behind the last node above the horizon they go on by the last quotient once.
  void line(const float* f, const float* l, std::size_t above, float* out) const noexcept {
    const std::size_t step = n_p_ * channels_;
    float last = 1, before = 1;
    for (std::size_t d = 0; d < above; ++d) {
      before = d > 0 ? last : 1;
      last = std::clamp((f[d] + epsilon_) / (l[d] + epsilon_), smallest_ratio, largest_ratio);
      out[d * step] = last;
    }
    const float quotient = above > 1 ? std::clamp(last / before, 1 / steepest, steepest) : 1.0f;
    const float beyond = std::clamp(last * quotient, smallest_ratio, largest_ratio);
    for (std::size_t d = above; d < n_d_; ++d) out[d * step] = beyond;
  }

  std::size_t n_d_, n_p_, channels_;
  float epsilon_;
  Pairs pairs_;
  std::vector<float> measured_, analytic_;  ///< [channel][pair]
  std::vector<std::size_t> above_;
  eval::Tables of_slices_, of_lobes_;
};

}  // namespace

std::size_t resample_temporary_bytes(const residual::SliceFrame& frame, int channels, const residual::GridSize& size) noexcept {
  const auto n_h = static_cast<std::size_t>(size.n_h), n_d = static_cast<std::size_t>(size.n_d), n_p = static_cast<std::size_t>(size.n_p);
  const auto n = static_cast<std::size_t>(channels), plane = n_d * n_p, lobes = n * most_lobes * sizeof(float);
  const std::size_t pairs = plane * (6 + 2 * n) * sizeof(float) + n_p * sizeof(std::size_t) + 2 * (n_h + n_d + n_p) * sizeof(Angle);
  const std::size_t filling = 2 * n_h * plane * n * sizeof(float) + pairs + 2 * lobes;
  return slices::SliceTable::bytes_of(frame, channels) + std::max(slices::SliceTable::temporary_bytes_of(frame, channels), filling);
}

residual::ResidualGrid resample_slices(const residual::Coefficients& c, const LobeSet& lobes, const residual::GridSize& size) {
  const residual::Basis basis = residual::basis_of(c.basis);
  const slices::SliceTable table(c);
  residual::ResidualGrid grid;
  grid.n_h = size.n_h;
  grid.n_d = size.n_d;
  grid.n_p = size.n_p;
  grid.channels = c.channels;
  grid.kappa_h = static_cast<float>(basis.kappa_h);
  grid.kappa_d = static_cast<float>(basis.kappa_d);
  grid.epsilon = static_cast<float>(basis.epsilon);

  const std::vector<Angle> halves = node_angles(size.n_h, basis.kappa_h), differences = node_angles(size.n_d, basis.kappa_d);
  std::vector<Angle> azimuths;
  for (int p = 0; p < size.n_p; ++p) {
    const double cosine = residual::cos_phi_of(static_cast<double>(p) / (size.n_p - 1));
    azimuths.push_back({static_cast<float>(std::sqrt(std::max(1 - cosine * cosine, 0.0))), static_cast<float>(cosine)});
  }
  const auto n_h = static_cast<std::size_t>(size.n_h), n_d = static_cast<std::size_t>(size.n_d), n_p = static_cast<std::size_t>(size.n_p);
  const auto channels = static_cast<std::size_t>(c.channels), plane = n_d * n_p * channels;
  std::vector<float> ratio(n_h * plane), moved(ratio.size());
  RatioPlane planes(table, lobes, size, grid.epsilon);
  for (std::size_t h = 0; h < n_h; ++h) planes.fill(halves[h], differences, azimuths, ratio.data() + h * plane);
  least_squares_nodes(ratio, n_h * n_d, n_p, channels, moved);
  least_squares_nodes(moved, n_h, n_d, n_p * channels, ratio);
  least_squares_nodes(ratio, 1, n_h, plane, moved);
  grid.ratio.assign(moved.size() + 8, residual::half_from_float(1.0f));
  to_halves(moved, std::span(grid.ratio).first(moved.size()));
  return grid;
}

}  // namespace brdf::decode
