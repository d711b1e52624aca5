// SPDX-License-Identifier: Apache-2.0
#include "fit/solve.h"

#include "fit/log_ratio_cost.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <chrono>

namespace brdf::fit {
namespace {

/// Samples of one residual block; its rows and Jacobian stay in the second-level cache.
constexpr std::size_t chunk = 512;

class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::function<bool()>& keep_going) : keep_going_(keep_going) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return keep_going_() ? ceres::SOLVER_CONTINUE : ceres::SOLVER_ABORT;
  }

 private:
  const std::function<bool()>& keep_going_;
};

}  // namespace

Solution solve(const PreparedSamples& samples, const Layout& layout, const std::vector<double>& start,
               const SolveLimits& limits, const std::function<bool()>& keep_going) {
  const auto begun = std::chrono::steady_clock::now();
  const std::size_t count = std::min(limits.samples, samples.size());
  Solution result;
  result.parameters = start;
  const auto [lower, upper] = parameter_bounds(layout);
  for (std::size_t k = 0; k < start.size(); ++k) {
    result.parameters[k] = std::clamp(start[k], lower[k], upper[k]);
  }
  double* const block = result.parameters.data();

  ceres::Problem problem;
  for (std::size_t s = 0; s < count; s += chunk) {
    problem.AddResidualBlock(new LogRatioCost(samples, layout, s, std::min(s + chunk, count)), nullptr, block);
  }
  for (int k = 0; k < layout.size(); ++k) {
    problem.SetParameterLowerBound(block, k, lower[static_cast<std::size_t>(k)]);
    problem.SetParameterUpperBound(block, k, upper[static_cast<std::size_t>(k)]);
  }

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = limits.iterations;
  options.function_tolerance = limits.tolerance;
  options.parameter_tolerance = 1e-6;  // of logarithms
  options.num_threads = 1;             // sums in one order: the same bits for any number of threads outside
  options.logging_type = ceres::SILENT;
  options.minimizer_progress_to_stdout = false;
  StopCallback stop(keep_going);
  options.callbacks.push_back(&stop);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  result.mean_loss = mean_loss(samples, layout, result.parameters, count);
  result.message = summary.message;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

double mean_loss(const PreparedSamples& samples, const Layout& layout, const std::vector<double>& p,
                 std::size_t count) {
  const LogRatioCost cost(samples, layout, 0, count);
  std::vector<double> rows(count * static_cast<std::size_t>(samples.channels));
  const double* const block = p.data();
  cost.Evaluate(&block, rows.data(), nullptr);
  double sum = 0, weight = 0;
  for (const double r : rows) sum += r * r;
  for (std::size_t s = 0; s < count; ++s) weight += samples.weight[s];
  return sum / (weight * samples.channels);
}

}  // namespace brdf::fit
