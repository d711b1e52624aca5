// SPDX-License-Identifier: Apache-2.0
#include "raw_table.h"

#include "ingest/half_difference_grid.h"

#include <array>

namespace brdf::peers {

HalfDifferenceTable resample_to_merl(const Measurement& m) {
  const MeasurementInterpolator interpolator(m);
  HalfDifferenceTable t;
  t.n_theta_h = t.n_theta_d = 90;
  t.n_phi_d = 180;
  const ingest::HalfDifferenceGrid grid(t);
  t.values.reserve(3 * grid.cells());
  t.valid.reserve(grid.cells());
  grid.for_each_cell([&](std::size_t, const Vec3d& wi, const Vec3d& wo) {
    std::array<double, 3> f{};
    t.valid.push_back(ingest::above_horizon(wi, wo) && interpolator.eval(wi, wo, f) ? 1 : 0);
    for (const double v : f) t.values.push_back(static_cast<float>(v));
  });
  return t;
}

}  // namespace brdf::peers
