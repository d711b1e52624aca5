// SPDX-License-Identifier: Apache-2.0
// The rows of `bench` as JSON, CSV, Markdown and a table on the terminal.
#pragma once

#include "bench_row.h"
#include "json_report.h"
#include "text_table.h"

#include <span>

namespace brdf::cli {

Json bench_json(std::span<const BenchRow> rows);
/// The columns are the keys of the JSON rows.
std::string bench_csv(std::span<const BenchRow> rows);
/// The main figures; a mean and a worst row for each setting that has several materials. `against_raw` adds how much
/// faster than the raw table evaluation is.
TextTable bench_table(std::span<const BenchRow> rows, bool against_raw);

}  // namespace brdf::cli
