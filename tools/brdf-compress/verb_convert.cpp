// SPDX-License-Identifier: Apache-2.0
#include "merl_export.h"
#include "output_file.h"
#include "verb_options.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string input, output, format = "merl";
  SourceOptions source;
  MerlExport table;
  bool force = false;
  Reporting reporting;
};

ExitCode run(const Options& o) {
  check_output(o.output, o.input, o.force);
  const MaterialSource source = MaterialSource::open(o.input, o.source);
  if (source.is_compressed()) {
    throw Failure(ExitCode::bad_input, o.input + ": is a .brdfc file and no measured one; 'decompress' takes those");
  }
  const std::vector<std::byte> bytes = export_merl(source, o.table);
  write_output(o.output, bytes, o.force);
  o.reporting.say(o.output + ": MERL layout, " + std::to_string(bytes.size()) + " bytes");
  return ExitCode::ok;
}

}  // namespace

Verb add_convert(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("convert", "Resample a measured file to another layout");
  verb->add_option("IN", o->input, "A measured file")->required();
  verb->add_option("-o,--output", o->output, "File to write")->type_name("OUT")->required();
  verb->add_option("--to", o->format, "Format to write")->check(CLI::IsMember({"merl"}))->capture_default_str();
  verb->add_flag("--full-circle", o->table.full_circle,
                 "360 instead of 180 bins of phi_d: keeps what is not reciprocal");
  add_position(*verb, o->source.position);
  verb->add_flag_callback(
      "--to-centre", [o] { o->table.position = SamplePosition::centre; },
      "Write samples at bin centres instead of bin edges");
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting, false);
  verb->footer(
      "Cells with a direction below the horizon, and those without a measured value, hold -1. A MERL table that has "
      "the\n"
      "wanted layout already keeps its samples as they are; --position says how IN is read.\n\n"
      "Examples:\n"
      "  brdf-compress convert gold_rgb.bsdf -o gold.binary\n"
      "  brdf-compress convert gold_rgb.bsdf -o gold360.binary --full-circle");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
