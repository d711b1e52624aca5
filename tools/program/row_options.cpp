// SPDX-License-Identifier: Apache-2.0
#include "row_options.h"

#include "options.h"

namespace brdf::cli {

void add_eval_level(CLI::App& verb, EvalLevel& level) {
  add_choice<EvalLevel>(
      verb, "--eval", level,
      {{"fast", EvalLevel::fast}, {"balanced", EvalLevel::balanced}, {"exact", EvalLevel::exact}},
      "Evaluation cost of a .brdfc file: lobes only, a small table, the full table (default balanced)");
}

void add_prefix(CLI::App& verb, std::optional<std::uint64_t>& prefix) {
  verb.add_option("--prefix", prefix, "Read only the first BYTES of a .brdfc file; 'info' lists where it may be cut")
      ->check(natural_number(1))
      ->type_name("BYTES");
}

void add_row_format(CLI::App& verb, RowFormat& format) {
  add_choice<RowFormat>(verb, "--format", format, {{"csv", RowFormat::csv}, {"f32", RowFormat::f32}},
                        "Rows as text, or as raw little-endian float32 (default csv)");
}

}  // namespace brdf::cli
