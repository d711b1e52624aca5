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
  if (!source.is_compressed()) {
    throw Failure(ExitCode::bad_input, o.input + ": is a measured file and no .brdfc; 'convert' takes those");
  }
  if (const AnalyticModel* model = source.material().analytic()) {
    const auto* ggx = std::get_if<GgxReflector>(model);
    if ((source.material().scatter_flags() & sample_delta) != 0 || (ggx != nullptr && ggx->alpha_x != ggx->alpha_y))
      throw Failure(ExitCode::bad_input, o.input + ": a table of half/difference angles holds neither delta lobes nor anisotropy");
  }
  const std::vector<std::byte> bytes = export_merl(source, o.table);
  write_output(o.output, bytes, o.force);
  o.reporting.say(o.output + ": MERL layout, " + std::to_string(bytes.size()) + " bytes, evaluated at " +
                  to_string(o.source.level));
  return ExitCode::ok;
}

}  // namespace

Verb add_decompress(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("decompress", "Write a .brdfc file as a table that other programs read");
  verb->add_option("IN", o->input, "A .brdfc file")->required();
  verb->add_option("-o,--output", o->output, "File to write")->type_name("OUT")->required();
  verb->add_option("--to", o->format, "Format to write")->check(CLI::IsMember({"merl"}))->capture_default_str();
  verb->add_flag("--full-circle", o->table.full_circle,
                 "360 instead of 180 bins of phi_d: keeps what is not reciprocal");
  add_eval_level(*verb, o->source.level);
  add_prefix(*verb, o->source.prefix);
  add_position(*verb, o->table.position);
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting, false);
  verb->footer(
      "The table has 90 x 90 x 180 bins of theta_h, theta_d, phi_d; cells with a direction below the horizon hold "
      "-1.\n\n"
      "Examples:\n"
      "  brdf-compress decompress gold.brdfc -o gold.binary\n"
      "  brdf-compress decompress gold.brdfc -o gold.binary --eval exact -f");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
