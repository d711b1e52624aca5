// SPDX-License-Identifier: Apache-2.0
// A file without the search that compress() makes for the best one: for many tables, or many channels, in little time.
#pragma once

#include "container/content.h"
#include "container/lobe_codes.h"
#include "encode/basis_choice.h"
#include "encode/candidate.h"
#include "encode/effort.h"
#include "encode/verification.h"

#include <cmath>

namespace brdf::test {

/// Quantised with one basis and one step, few cells in the error model; the errors are measured before it is coded.
inline container::Content one_basis_content(const Measurement& m, const LobeSet& lobes, const encode::Verification& verification,
                                            residual::Azimuth azimuth, int step_code) {
  const double epsilon = encode::residual_epsilon(m);
  const container::Content frame = encode::frame_of(m, container::quantise_lobes(lobes), epsilon, false);
  encode::EffortStep effort = encode::effort_step(0);
  effort.bins_h = 10, effort.bins_d = 6, effort.bins_p = 6;
  const encode::SourceData source(m, frame, effort);
  const auto basis = encode::basis_variants(frame.lobes, epsilon, 1).front();
  container::Content content = encode::Candidate::half_difference(source, basis, azimuth, 40).encode(step_code, 0.3, 1).content;
  container::set_symmetries(content.component, content.residual);
  container::Content alone = content;
  alone.residual.layers.clear();
  const auto record = [&](int refinement, EvalLevel level, const ErrorReport& report) {
    content.errors.push_back({refinement, level, report.log_mae.all, report.psnr_env});
  };
  const ErrorReport of_lobes = verification.score(container::pack(alone), EvalLevel::fast);
  const ErrorReport of_all = verification.score(container::pack(content), EvalLevel::balanced);
  content.errors.clear();
  record(0, EvalLevel::fast, of_lobes);
  if (!content.residual.empty()) {
    record(1, EvalLevel::balanced, of_all);
    content.errors.push_back({1, EvalLevel::exact, std::nan(""), std::nan("")});  // not recorded
  }
  return content;
}

}  // namespace brdf::test
