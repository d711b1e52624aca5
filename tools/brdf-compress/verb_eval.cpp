// SPDX-License-Identifier: Apache-2.0
#include "row_queries.h"
#include "verb_options.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string material;
  SourceOptions source;
  RowFormat format = RowFormat::csv;
};

ExitCode run(const Options& o) {
  const MaterialSource source = MaterialSource::open(o.material, o.source);
  answer_rows(source.rows(), source.channels().count, o.format);
  return ExitCode::ok;
}

}  // namespace

Verb add_eval(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("eval", "Evaluate f(wi, wo) for rows of directions on stdin");
  verb->add_option("MATERIAL", o->material, "A .brdfc or measured file")->required();
  add_row_format(*verb, o->format);
  add_eval_level(*verb, o->source.level);
  add_prefix(*verb, o->source.prefix);
  add_position(*verb, o->source.position);
  verb->footer(
      "stdin: rows of wi.x wi.y wi.z wo.x wo.y wo.z, unit vectors away from the surface, z the normal.\n"
      "stdout: f in 1/sr without the cosine, one number per channel; 0 below the horizon and where nothing was "
      "measured.\n"
      "Directions off by more than 0.001 in length are scaled to length 1. Text lines may use commas or blanks; empty\n"
      "lines and lines that start with # are skipped.\n\n"
      "Examples:\n"
      "  echo 0,0,1,0.6,0,0.8 | brdf-compress eval gold.brdfc\n"
      "  brdf-compress eval gold.brdfc --eval exact --format f32 < directions.f32 > values.f32");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
