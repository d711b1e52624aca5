// SPDX-License-Identifier: Apache-2.0
#include "decode/resample_slices.h"

#include "eval/lobe_params.h"
#include "eval/scalar_eval.h"
#include "residual/basis.h"
#include "residual/half_float.h"
#include "slices/slice_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::decode {
namespace {

constexpr double smallest_sine = 1e-6;    // a pole's neighbourhood stands for the pole
constexpr double lowest_cosine = 0.012;   // 89.3 degrees: beyond, 1 / cos theta_o takes over
constexpr float largest_log_ratio = 9.6f;   // normal half floats
constexpr float smallest_ratio = 6.2e-5f, largest_ratio = 32000.0f;
constexpr float steepest = 0.7f;            // of the log ratio across the horizon

struct Angle {
  double sine, cosine;
};

Angle node_angle(int i, int n, double kappa) noexcept {
  const double t = residual::unwarp(static_cast<double>(i) / (n - 1), kappa);  // sqrt(1 - cos theta)
  const double cosine = 1 - t * t, sine = std::sqrt(std::max(1 - cosine * cosine, smallest_sine * smallest_sine));
  return {sine, cosine};
}

/// Lines between nodes on a curve lie to one side of it. Moved by a twelfth of the second difference they fit it best in the
/// least-squares sense. Along the middle axis of [outer][n][inner]; ends stay, and no node moves by more than
/// a twentieth: where it would have to, the nodes do not resolve the curve.
std::vector<float> least_squares_nodes(const std::vector<float>& nodes, std::size_t outer, std::size_t n, std::size_t inner) {
  std::vector<float> out = nodes;
  for (std::size_t a = 0; a < outer; ++a)
    for (std::size_t i = 1; i + 1 < n; ++i)
      for (std::size_t k = 0; k < inner; ++k) {
        const std::size_t at = (a * n + i) * inner + k;
        const float bend = nodes[at - inner] - 2 * nodes[at] + nodes[at + inner];
        out[at] = nodes[at] - std::clamp(bend / 12, -0.05f * nodes[at], 0.05f * nodes[at]);
      }
  return out;
}

}  // namespace

residual::ResidualGrid resample_slices(const residual::Coefficients& c, const LobeSet& lobes, const residual::GridSize& size) {
  const residual::Basis basis = residual::basis_of(c.basis);
  const slices::SliceTable table(c);
  const eval::LobeParams analytic(lobes);
  const eval::GridParams none;
  const auto channels = static_cast<std::size_t>(c.channels);

  residual::ResidualGrid grid;
  grid.n_h = size.n_h;
  grid.n_d = size.n_d;
  grid.n_p = size.n_p;
  grid.channels = c.channels;
  grid.kappa_h = static_cast<float>(basis.kappa_h);
  grid.kappa_d = static_cast<float>(basis.kappa_d);
  grid.epsilon = static_cast<float>(basis.epsilon);
  const auto stride_d = static_cast<std::size_t>(size.n_p) * channels, stride_h = static_cast<std::size_t>(size.n_d) * stride_d;
  grid.ratio.assign(static_cast<std::size_t>(size.n_h) * stride_h + 8, residual::half_from_float(1.0f));

  std::vector<float> ratio(grid.ratio.size() - 8);
  std::vector<float> f(channels), l(channels);
  std::vector<float> line(static_cast<std::size_t>(size.n_d) * channels);  // log ratio along theta_d
  std::vector<Angle> differences;
  for (int d = 0; d < size.n_d; ++d) differences.push_back(node_angle(d, size.n_d, basis.kappa_d));
  for (int h = 0; h < size.n_h; ++h) {
    const Angle half = node_angle(h, size.n_h, basis.kappa_h);
    for (int p = 0; p < size.n_p; ++p) {
      const double cos_phi = residual::cos_phi_of(static_cast<double>(p) / (size.n_p - 1));
      const double sin_phi = std::sqrt(std::max(1 - cos_phi * cos_phi, 0.0));
      int above = 0;  // nodes above the horizon; they come first
      for (; above < size.n_d; ++above) {
        const Angle& difference = differences[static_cast<std::size_t>(above)];
        const double x = difference.sine * cos_phi, y = difference.sine * sin_phi;
        const Vec3d wi{half.cosine * x + half.sine * difference.cosine, y, half.cosine * difference.cosine - half.sine * x};
        const Vec3d wo{half.sine * difference.cosine - half.cosine * x, -y, half.cosine * difference.cosine + half.sine * x};
        if (std::min(wi.z, wo.z) < lowest_cosine) break;
        table.eval(slices::slice_angles(wi.x, wi.y, wi.z, wo.x, wo.y, wo.z), wo.z, f);
        eval::eval_scalar(analytic, none, Vec3f(wi), Vec3f(wo), l);
        for (std::size_t ch = 0; ch < channels; ++ch)
          line[static_cast<std::size_t>(above) * channels + ch] = std::clamp(
              std::log((f[ch] + grid.epsilon) / (l[ch] + grid.epsilon)), -largest_log_ratio, largest_log_ratio);
      }
      for (int d = 0; d < size.n_d; ++d) {
        float* out = ratio.data() + static_cast<std::size_t>(h) * stride_h + static_cast<std::size_t>(d) * stride_d +
                             static_cast<std::size_t>(p) * channels;
        for (std::size_t ch = 0; ch < channels; ++ch) {
          float value = 0;
          if (d < above) {
            value = line[static_cast<std::size_t>(d) * channels + ch];
          } else if (above > 0) {
            const float last = line[static_cast<std::size_t>(above - 1) * channels + ch];
            const float slope = above > 1 ? last - line[static_cast<std::size_t>(above - 2) * channels + ch] : 0.0f;
            value = std::clamp(last + std::clamp(slope, -steepest, steepest), -largest_log_ratio, largest_log_ratio);
          }
          out[ch] = std::exp(value);
        }
      }
    }
  }
  const std::size_t n_h = static_cast<std::size_t>(size.n_h), n_d = static_cast<std::size_t>(size.n_d), n_p = static_cast<std::size_t>(size.n_p);
  ratio = least_squares_nodes(ratio, n_h * n_d, n_p, channels);
  ratio = least_squares_nodes(ratio, n_h, n_d, n_p * channels);
  ratio = least_squares_nodes(ratio, 1, n_h, n_d * n_p * channels);
  for (std::size_t i = 0; i < ratio.size(); ++i) grid.ratio[i] = residual::half_from_float(std::clamp(ratio[i], smallest_ratio, largest_ratio));
  return grid;
}

}  // namespace brdf::decode
