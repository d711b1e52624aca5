// SPDX-License-Identifier: Apache-2.0
// Calls into each half of the installed encoder: a reader that refuses a file, and a fit.

#include <brdf/error.h>
#include <brdf/fit.h>
#include <brdf/ingest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace {

/// A small table of a Lambertian reflector of reflectance 1/2.
brdf::Measurement lambert_table() {
  brdf::HalfDifferenceTable table;
  table.n_theta_h = table.n_theta_d = 16;
  table.n_phi_d = 32;
  const std::size_t cells = 16 * 16 * 32;
  table.values.assign(cells * 3, static_cast<float>(0.5 / std::acos(-1.0)));
  table.valid.assign(cells, 1);
  brdf::Measurement m;
  m.table = table;
  return m;
}

}  // namespace

int main() {
  try {
    brdf::read_measurement(std::filesystem::path("/nonexistent/table.binary"));
    std::printf("FAILED: a missing file was read\n");
    return 1;
  } catch (const brdf::Error& e) {
    if (e.code() != brdf::ErrorCode::io) {
      std::printf("FAILED: a missing file gave %s\n", brdf::to_string(e.code()));
      return 1;
    }
  }
  brdf::FitOptions options;
  options.max_lobes = 1;
  options.starts = 1;
  const brdf::FitResult fit = brdf::fit_lobes(lambert_table(), options);
  double reflectance = 0;
  for (const brdf::Lobe& lobe : fit.lobes.lobes) {
    if (lobe.kind == brdf::LobeKind::lambert) reflectance += lobe.color[0];
  }
  std::printf("%s; reflectance %.4f\n", fit.summary.brief().c_str(), reflectance);
  return std::abs(reflectance - 0.5) < 0.01 ? 0 : 1;
}
