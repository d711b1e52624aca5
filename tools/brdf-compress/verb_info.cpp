// SPDX-License-Identifier: Apache-2.0
#include "info_report.h"
#include "standard_output.h"
#include "verb_options.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string file;
  SourceOptions source;
  Reporting reporting;
};

ExitCode run(const Options& o) {
  const MaterialSource source = MaterialSource::open(o.file, o.source);
  const Json row = source.is_compressed() ? compressed_info(source) : measured_info(source);
  if (o.reporting.json) {
    print(json_report("info", Json::array({row})));
  } else {
    print(source.is_compressed() ? compressed_text(row) : measured_text(row));
  }
  return ExitCode::ok;
}

}  // namespace

Verb add_info(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("info", "What is in a file, and what to know before trusting it");
  verb->add_option("FILE", o->file, "A .brdfc or measured file")->required();
  add_prefix(*verb, o->source.prefix);
  add_position(*verb, o->source.position);
  add_reporting(*verb, o->reporting);
  verb->footer(
      "Measured files: shape, missing and negative values, asymmetries, largest albedo. Compressed files: lobes, the "
      "bytes\n"
      "at which the file may be cut (--prefix) with the errors recorded there, and the size of the tables in "
      "memory.\n\n"
      "Examples:\n"
      "  brdf-compress info gold.binary\n"
      "  brdf-compress info gold.brdfc --json");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
