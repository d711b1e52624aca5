// SPDX-License-Identifier: Apache-2.0
// Names of the metrics and the single numbers that stand for them.
#include <brdf/metrics.h>

namespace brdf {
namespace {

struct Row {
  Metric metric;
  const char* name;
  bool larger_is_better;
};

constexpr std::array<Row, 6> table{{{Metric::log_mae, "log_mae", false},
                                    {Metric::cbrt_rms, "cbrt_rms", false},
                                    {Metric::psnr_env, "psnr_env", true},
                                    {Metric::psnr_lights, "psnr_lights", true},
                                    {Metric::albedo_error, "albedo_error", false},
                                    {Metric::profile, "profile", false}}};

}  // namespace

const char* to_string(Metric m) noexcept {
  for (const Row& row : table)
    if (row.metric == m) return row.name;
  return "unknown";
}

std::optional<Metric> metric_from_string(std::string_view name) noexcept {
  for (const Row& row : table)
    if (name == row.name) return row.metric;
  return std::nullopt;
}

double ErrorReport::get(Metric m) const noexcept {
  switch (m) {
    case Metric::log_mae: return log_mae.all;
    case Metric::cbrt_rms: return cbrt_rms.all;
    case Metric::psnr_env: return psnr_env;
    case Metric::psnr_lights: return psnr_lights;
    case Metric::albedo_error: return albedo_error;
    case Metric::profile: return profile.rms;
  }
  return 0;
}

bool ErrorReport::meets(const ErrorTarget& t) const noexcept {
  for (const Row& row : table)
    if (row.metric == t.metric) return row.larger_is_better ? get(t.metric) >= t.value : get(t.metric) <= t.value;
  return false;
}

}  // namespace brdf
