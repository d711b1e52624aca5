// SPDX-License-Identifier: Apache-2.0
#include "error_report_json.h"

#include <array>

namespace brdf::cli {
namespace {

void add_bands(Json& row, const std::string& name, const BandedError& e) {
  constexpr std::array bands{"_0_60", "_60_75", "_75_85", "_85_90"};
  row[name] = e.all;
  for (std::size_t k = 0; k < bands.size(); ++k) row[name + bands[k]] = e.band[k];
  row[name + "_p95"] = e.p95;
  row[name + "_max"] = e.max;
}

}  // namespace

void add_errors(Json& row, const ErrorReport& report) {
  constexpr std::array lights{"front", "deg45", "grazing", "top"};
  add_bands(row, "log_mae", report.log_mae);
  add_bands(row, "cbrt_rms", report.cbrt_rms);
  row["cos_l2"] = report.cos_l2;
  row["psnr_env"] = report.psnr_env;
  row["psnr_lights"] = report.psnr_lights;
  for (std::size_t k = 0; k < lights.size(); ++k) row[std::string("psnr_") + lights[k]] = report.psnr_light[k];
  row["albedo_error"] = report.albedo_error;
  row["not_finite"] = report.not_finite;
  row["negative"] = report.negative;
}

}  // namespace brdf::cli
