// SPDX-License-Identifier: Apache-2.0
#include "encode/basis_choice.h"

#include "encode/scattered_pairs.h"

#include <algorithm>
#include <cmath>

namespace brdf::encode {

double residual_epsilon(const Measurement& m) {
  // median brightness, so that any unit of the source works
  const MeasurementInterpolator reference(m);
  std::vector<double> f(static_cast<std::size_t>(m.channels.count)), seen;
  for_scattered_pairs(400, [&](const Vec3d& wi, const Vec3d& wo) {
    if (!reference.eval(wi, wo, f)) return;
    double mean = 0;
    for (const double v : f) mean += v;
    if (mean > 0) seen.push_back(mean / static_cast<double>(f.size()));
  });
  constexpr double usual = 1.0 / 1024;
  if (seen.empty()) return usual;
  std::nth_element(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2), seen.end());
  const double median = seen[seen.size() / 2];
  return median > 1e-3 && median < 10 ? usual : usual * median / 0.05;
}

std::vector<residual::BasisCodes> basis_variants(const LobeSet& lobes, double epsilon, int count) {
  double alpha = 1;
  for (const Lobe& lobe : lobes.lobes)
    if (lobe.kind != LobeKind::lambert) alpha = std::min(alpha, lobe.alpha);
  residual::BasisCodes usual;
  usual.kappa_h = static_cast<std::uint8_t>(residual::kappa_h_code(alpha));
  usual.kappa_d = static_cast<std::uint8_t>(residual::kappa_d_code(4.0));
  usual.window_h = static_cast<std::uint8_t>(residual::window_code(std::clamp(alpha, 0.03, 0.6)));
  usual.window_d = static_cast<std::uint8_t>(residual::window_code(0.25));
  usual.epsilon = static_cast<std::uint8_t>(residual::epsilon_code(epsilon));
  usual.shape = 2;

  std::vector<residual::BasisCodes> out{usual};
  const auto add = [&](int kappa_h, int window_h, int shape, int kappa_d, int window_d) {
    residual::BasisCodes v = usual;
    v.kappa_h = static_cast<std::uint8_t>(std::clamp(v.kappa_h + kappa_h, 0, 31));
    v.window_h = static_cast<std::uint8_t>(std::clamp(v.window_h + window_h, 0, 15));
    v.kappa_d = static_cast<std::uint8_t>(std::clamp(v.kappa_d + kappa_d, 0, 15));
    v.window_d = static_cast<std::uint8_t>(std::clamp(v.window_d + window_d, 0, 15));
    v.shape = static_cast<std::uint8_t>(shape);
    out.push_back(v);
  };
  add(3, 1, 2, 0, 0);
  add(-3, -1, 2, 0, 0);
  add(0, 2, 2, 0, 0);
  add(0, 0, 0, 0, 0);
  add(6, 3, 2, 0, 0);
  add(0, 0, 2, -3, 0);
  add(0, -2, 5, 0, 0);
  add(3, 3, 4, 0, 2);
  add(-5, 0, 6, 0, 0);
  add(3, 0, 7, 0, -2);
  add(-3, 2, 1, 0, 2);
  out.resize(std::min(out.size(), static_cast<std::size_t>(std::max(count, 1))));
  return out;
}

}  // namespace brdf::encode
