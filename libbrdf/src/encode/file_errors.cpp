// SPDX-License-Identifier: Apache-2.0
#include "encode/file_errors.h"

#include <algorithm>
#include <vector>

namespace brdf::encode {
namespace {

/// Layer i + 1 takes layer i in. Both go on where the one before ended, as all layers of the encoder do.
void merge_into_next(std::vector<residual::Layer>& layers, std::size_t i) {
  residual::Layer& next = layers[i + 1];
  for (std::size_t c = 0; c < next.q.size(); ++c) next.q[c].insert(next.q[c].begin(), layers[i].q[c].begin(), layers[i].q[c].end());
  layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace

void record_errors(Encoded& e, const Verification& verification, EvalLevel level, const Worth& worth) {
  std::vector<residual::Layer>& layers = e.content.residual.layers;
  const std::vector<residual::Layer> all = layers;
  const auto measure = [&](std::size_t count, EvalLevel at) {
    Encoded part;
    part.content = e.content;
    part.content.residual.layers.assign(layers.begin(), layers.begin() + static_cast<std::ptrdiff_t>(count));
    return verification.score(container::pack(part.content), at);
  };
  e.content.errors.clear();
  const ErrorReport alone = measure(0, EvalLevel::fast);
  e.content.errors.push_back({0, EvalLevel::fast, alone.log_mae.all, alone.psnr_env});
  double best = worth(alone);
  for (std::size_t i = 0; i < layers.size();) {
    const ErrorReport balanced = measure(i + 1, EvalLevel::balanced), exact = measure(i + 1, EvalLevel::exact);
    const double now = worth(level == EvalLevel::exact ? exact : balanced);
    if (!(now > best) && level != EvalLevel::fast) {
      if (i + 1 < layers.size())
        merge_into_next(layers, i);
      else
        layers.pop_back();
      continue;
    }
    best = now;
    ++i;
    e.content.errors.push_back({static_cast<int>(i), EvalLevel::balanced, balanced.log_mae.all, balanced.psnr_env});
    e.content.errors.push_back({static_cast<int>(i), EvalLevel::exact, exact.log_mae.all, exact.psnr_env});
  }
  container::set_symmetries(e.content.component, e.content.residual);
  e.bytes = container::pack(e.content);
}

}  // namespace brdf::encode
