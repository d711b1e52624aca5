// SPDX-License-Identifier: Apache-2.0
#include "fit/channel_colors.h"

#include "fit/parallel_jobs.h"
#include "fit/robust_loss.h"
#include "lobes/lambert.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace brdf::fit {
namespace {

constexpr double min_log_color = -20.7, max_log_color = 20.7;  // as in parameter_bounds

/// Model of one channel: sum over lobes of color_l * by_color[l] + constant, for every sample.
struct FixedShapes {
  std::vector<double> by_color;  ///< [sample][lobe]
  std::vector<double> constant;  ///< the f90 terms
};

FixedShapes fixed_shapes(const PreparedSamples& samples, const LobeSet& lobes) {
  FixedShapes fixed;
  const std::size_t n = samples.size(), n_lobes = lobes.lobes.size();
  fixed.by_color.resize(n * n_lobes);
  fixed.constant.resize(n);
  for (std::size_t l = 0; l < n_lobes; ++l) {
    const Lobe& lobe = lobes.lobes[l];
    for (std::size_t s = 0; s < n; ++s) {
      if (lobe.kind == LobeKind::lambert) {
        fixed.by_color[s * n_lobes + l] = lobes::inv_pi;
        continue;
      }
      const lobes::LobeGeometry& g = lobe.kind == LobeKind::ggx ? samples.mirror[s] : samples.retro[s];
      const double shape = lobes::ggx_shape(g, lobe.alpha);
      fixed.by_color[s * n_lobes + l] = shape * (1 - g.schlick_weight);
      fixed.constant[s] += shape * lobe.f90 * g.schlick_weight;
    }
  }
  return fixed;
}

class ColorCost final : public ceres::CostFunction {
 public:
  ColorCost(const PreparedSamples& samples, const FixedShapes& fixed, std::vector<double> log_target, int lobes)
      : samples_(samples), fixed_(fixed), log_target_(std::move(log_target)), lobes_(static_cast<std::size_t>(lobes)) {
    set_num_residuals(static_cast<int>(samples.size()));
    mutable_parameter_block_sizes()->push_back(lobes);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    std::vector<double> color(lobes_);
    std::transform(parameters[0], parameters[0] + lobes_, color.begin(), [](double v) { return std::exp(v); });
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      const double* const by_color = fixed_.by_color.data() + s * lobes_;
      double model = fixed_.constant[s];
      for (std::size_t l = 0; l < lobes_; ++l) model += by_color[l] * color[l];
      const double shifted = model * samples_.cos_i[s] + log_offset;
      const SoftL1 loss = soft_l1(log_target_[s] - std::log(shifted));
      residuals[s] = samples_.root_weight[s] * loss.value;
      if (jacobians == nullptr || jacobians[0] == nullptr) continue;
      const double by_model = -samples_.root_weight[s] * loss.slope * samples_.cos_i[s] / shifted;
      for (std::size_t l = 0; l < lobes_; ++l) jacobians[0][s * lobes_ + l] = by_model * by_color[l] * color[l];
    }
    return true;
  }

 private:
  const PreparedSamples& samples_;
  const FixedShapes& fixed_;
  std::vector<double> log_target_;
  std::size_t lobes_;
};

}  // namespace

LobeSet fit_channel_colors(const SampleSet& set, const PreparedSamples& prepared, const LobeSet& lobes, int threads,
                           const std::function<bool(bool on_caller)>& keep_going) {
  const FixedShapes fixed = fixed_shapes(prepared, lobes);
  const auto channels = static_cast<std::size_t>(set.channels);
  const std::size_t n_lobes = lobes.lobes.size();
  LobeSet full = lobes;
  full.channels = set.channels;
  for (Lobe& lobe : full.lobes) lobe.color.assign(channels, 0.0);

  std::vector<int> group_of(channels);
  for (int g = 0; g < prepared.channels; ++g) {
    const ChannelGroup range = channel_group(set.channels, prepared.channels, g);
    std::fill(group_of.begin() + range.begin, group_of.begin() + range.end, g);
  }
  run_jobs(channels, threads, [&](std::size_t c, bool on_caller) {
    if (!keep_going(on_caller)) return;
    std::vector<double> log_target(set.size()), p(n_lobes);
    for (std::size_t s = 0; s < set.size(); ++s) {
      log_target[s] = std::log(set.values[s * channels + c] / prepared.scale * prepared.cos_i[s] + log_offset);
    }
    for (std::size_t l = 0; l < n_lobes; ++l) {
      p[l] = std::log(lobes.lobes[l].color[static_cast<std::size_t>(group_of[c])]);
    }
    ceres::Problem problem;
    problem.AddResidualBlock(new ColorCost(prepared, fixed, std::move(log_target), static_cast<int>(n_lobes)), nullptr,
                             p.data());
    for (std::size_t l = 0; l < n_lobes; ++l) {
      p[l] = std::clamp(p[l], min_log_color, max_log_color);
      problem.SetParameterLowerBound(p.data(), static_cast<int>(l), min_log_color);
      problem.SetParameterUpperBound(p.data(), static_cast<int>(l), max_log_color);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 20;
    options.function_tolerance = 1e-5;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    for (std::size_t l = 0; l < n_lobes; ++l) full.lobes[l].color[c] = std::exp(p[l]);
  });
  return full;
}

void clear_invisible_colors(const PreparedSamples& prepared, LobeSet& lobes) {
  constexpr double visible = 0.05 * log_offset;
  for (Lobe& lobe : lobes.lobes) {
    // largest cos_i times the lobe, per unit of colour and of f90
    double by_color = lobe.kind == LobeKind::lambert ? lobes::inv_pi : 0, by_f90 = 0;
    if (lobe.kind != LobeKind::lambert) {
      const auto& geometry = lobe.kind == LobeKind::ggx ? prepared.mirror : prepared.retro;
      for (std::size_t s = 0; s < prepared.size(); ++s) {
        const double shape = prepared.cos_i[s] * lobes::ggx_shape(geometry[s], lobe.alpha);
        by_color = std::max(by_color, shape * (1 - geometry[s].schlick_weight));
        by_f90 = std::max(by_f90, shape * geometry[s].schlick_weight);
      }
      if (lobe.f90 * by_f90 < visible) lobe.f90 = 0;
    }
    for (double& c : lobe.color) c = c * by_color < visible ? 0.0 : c;
  }
}

}  // namespace brdf::fit
