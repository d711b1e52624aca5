// SPDX-License-Identifier: Apache-2.0
#include "fit/log_ratio_cost.h"

#include "fit/robust_loss.h"
#include "lobes/lambert.h"
#include "lobes/lobe_jacobian.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brdf::fit {

LogRatioCost::LogRatioCost(const PreparedSamples& samples, const Layout& layout, std::size_t begin, std::size_t end)
    : samples_(samples), layout_(layout), begin_(begin), end_(end) {
  set_num_residuals(static_cast<int>(end - begin) * samples.channels);
  mutable_parameter_block_sizes()->push_back(layout.size());
}

bool LogRatioCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const auto n_lobes = layout_.kinds().size();
  const auto channels = static_cast<std::size_t>(samples_.channels), columns = static_cast<std::size_t>(layout_.size());
  std::vector<double> p(columns);
  std::transform(parameters[0], parameters[0] + columns, p.begin(), [](double v) { return std::exp(v); });
  double* const jacobian = jacobians != nullptr ? jacobians[0] : nullptr;
  std::vector<lobes::ShapeDerivative> shape(n_lobes);
  std::vector<double> weight(n_lobes);

  for (std::size_t s = begin_; s < end_; ++s) {
    for (std::size_t l = 0; l < n_lobes; ++l) {
      const LobeKind kind = layout_.kinds()[l];
      if (kind == LobeKind::lambert) continue;
      const lobes::LobeGeometry& g = kind == LobeKind::ggx ? samples_.mirror[s] : samples_.retro[s];
      const double alpha = p[static_cast<std::size_t>(layout_.shape(l))];
      weight[l] = g.schlick_weight;
      if (jacobian != nullptr) {
        shape[l] = lobes::ggx_shape_derivative(g, alpha);
      } else {
        shape[l].value = lobes::ggx_shape(g, alpha);
      }
    }
    for (std::size_t c = 0; c < channels; ++c) {
      double model = 0;
      for (std::size_t l = 0; l < n_lobes; ++l) {
        const double color = p[static_cast<std::size_t>(layout_.color(l)) + c];
        model +=
            layout_.kinds()[l] == LobeKind::lambert
                ? lobes::lambert(color)
                : shape[l].value * lobes::schlick(color, p[static_cast<std::size_t>(layout_.shape(l)) + 1], weight[l]);
      }
      const std::size_t row = (s - begin_) * channels + c;
      const double cosine = samples_.cos_i[s], shifted = model * cosine + log_offset;
      const SoftL1 loss = soft_l1(samples_.log_target[s * channels + c] - std::log(shifted));
      residuals[row] = samples_.root_weight[s] * loss.value;
      if (jacobian == nullptr) continue;

      double* const j = jacobian + row * columns;
      std::fill(j, j + columns, 0.0);
      const double by_model = -samples_.root_weight[s] * loss.slope * cosine / shifted;
      for (std::size_t l = 0; l < n_lobes; ++l) {
        // parameters are logarithms, so each derivative carries its parameter as a factor
        const auto at = static_cast<std::size_t>(layout_.color(l)) + c;
        if (layout_.kinds()[l] == LobeKind::lambert) {
          j[at] = by_model * lobes::lambert(p[at]);
          continue;
        }
        const auto first = static_cast<std::size_t>(layout_.shape(l));
        const double f90 = p[first + 1];
        j[first] = by_model * p[first] * shape[l].d_alpha * lobes::schlick(p[at], f90, weight[l]);
        j[first + 1] = by_model * shape[l].value * f90 * weight[l];
        j[at] = by_model * shape[l].value * p[at] * (1 - weight[l]);
      }
    }
  }
  return true;
}

}  // namespace brdf::fit
