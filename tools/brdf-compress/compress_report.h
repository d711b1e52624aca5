// SPDX-License-Identifier: Apache-2.0
// What `compress` says when it is done.
#pragma once

#include "json_report.h"

#include <brdf/encode.h>

#include <string>
#include <vector>

namespace brdf::cli {

struct CompressReport {
  const std::string& input;
  const std::string& output;
  const Measurement& measurement;
  const EncodeOptions& options;
  const EncodeSummary& summary;
};

/// A few lines for people.
std::vector<std::string> summary_lines(const CompressReport& report);
/// Why each lobe is there, or is not, and where the time went.
std::vector<std::string> detail_lines(const CompressReport& report);
Json json_row(const CompressReport& report);

}  // namespace brdf::cli
