// SPDX-License-Identifier: Apache-2.0
#include "encode/error_search.h"

#include "encode/layers.h"

#include <brdf/error.h>

#include <cstdio>
#include <optional>

namespace brdf::encode {

Encoded encode_to_error(const Measurement& m, const container::Content& frame, const residual::BasisCodes& basis,
                        bool reciprocal, const EffortStep& effort, const metrics::QuerySet& queries, const ErrorTarget& target,
                        EvalLevel level, const Verification& verification) {
  DecodeOptions decode;
  decode.level = level;
  decode.sampling = false;
  std::optional<double> best_value;
  const auto meets = [&](const Encoded& e) {
    const ErrorReport r = verification.score(Material::decode(e.bytes, decode));
    const double v = r.get(target.metric);
    const bool larger_is_better = target.metric == Metric::psnr_env || target.metric == Metric::psnr_lights;
    if (!best_value || (larger_is_better ? v > *best_value : v < *best_value)) best_value = v;
    return r.meets(target);
  };
  Encoded alone = lobes_only(frame);
  if (meets(alone)) return alone;

  // more candidates for finer targets; the first set that reaches the target is searched for its coarsest step
  EffortStep step = effort;
  constexpr int coarsest = 24, finest = 112;
  for (int round = 0; round < 2; ++round, step.coefficients *= 2) {
    const Candidate candidate = Candidate::half_difference(m, frame, basis, reciprocal, step, queries);
    const auto encode_at = [&](int code) {
      Encoded e = candidate.encode(code, 1.0, 1);
      const int layers = layer_count(e.bytes.size());
      return layers == 1 ? e : candidate.encode(code, 1.0, layers);
    };
    Encoded found = encode_at(finest);
    if (!meets(found)) continue;
    int low = coarsest, high = finest;
    while (low < high) {
      const int middle = (low + high) / 2;
      Encoded e = encode_at(middle);
      if (meets(e)) {
        found = std::move(e);
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return found;
  }
  char text[160];
  std::snprintf(text, sizeof text, "compress: %s of %.6g cannot be reached at level %s, the best reachable value is %.6g",
                to_string(target.metric), target.value, to_string(level), *best_value);
  throw Error(ErrorCode::target_not_met, text);
}

}  // namespace brdf::encode
