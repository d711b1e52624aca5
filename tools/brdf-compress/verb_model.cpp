// SPDX-License-Identifier: Apache-2.0
#include "output_file.h"
#include "verb_options.h"
#include "verbs.h"

#include <brdf/encode.h>

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::vector<float> colour, wavelengths;
  GgxReflector ggx;
  Dielectric glass;
  std::optional<float> alpha;
  std::string output, name, licence;
  bool force = false;
  Reporting reporting;
};

ExitCode write(const Options& o, const AnalyticModel& model) {
  check_output(o.output, {}, o.force);
  const Provenance provenance{o.name, "formula", name_of(model), o.licence, 0, 0};
  const Channels spectral{ChannelModel::spectral, static_cast<int>(o.wavelengths.size()), o.wavelengths};
  const bool described = !o.name.empty() || !o.licence.empty();
  const std::vector<std::byte> bytes =
      pack_analytic(model, described ? &provenance : nullptr, o.wavelengths.empty() ? nullptr : &spectral);
  write_output(o.output, bytes, o.force);
  o.reporting.say(o.output + ": " + name_of(model) + ", " + std::to_string(bytes.size()) + " bytes");
  return ExitCode::ok;
}

/// A value that means nothing is the caller's mistake, not the file's.
ExitCode run(const Options& o, const AnalyticModel& model) {
  try {
    return write(o, model);
  } catch (const Error& e) {
    if (e.code() == ErrorCode::invalid_argument) throw Failure(ExitCode::usage, e.what());
    throw;
  }
}

CLI::Option* add_colour(CLI::App& verb, const char* name, Options& o, const char* text) {
  return verb.add_option(name, o.colour, text)->delimiter(',')->type_name("A,B,..")->required();
}

}  // namespace

Verb add_model(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("model", "Write an analytic material as a .brdfc file");
  verb->require_subcommand(1);
  CLI::App* lambert = verb->add_subcommand("lambert", "The perfect diffuser");
  add_colour(*lambert, "--albedo", *o, "Albedo of each channel, 0 to 1");
  CLI::App* ggx = verb->add_subcommand("ggx", "Glossy microfacet reflection (GGX, Smith, Schlick)");
  ggx->add_option("--alpha", o->alpha, "Roughness in both directions, 1e-4 to 1")->type_name("A");
  CLI::Option* along = ggx->add_option("--alpha-x", o->ggx.alpha_x, "Roughness along the tangent")->type_name("A");
  CLI::Option* across = ggx->add_option("--alpha-y", o->ggx.alpha_y, "Roughness across it")->type_name("A");
  add_colour(*ggx, "--f0", *o, "Reflectance of each channel at normal incidence, 0 to 1");
  ggx->add_flag("--multiple-scattering", o->ggx.multiple_scattering, "Add what further bounces return; with one roughness only");
  CLI::App* mirror = verb->add_subcommand("mirror", "The ideal mirror");
  add_colour(*mirror, "--reflectance", *o, "Reflectance of each channel, 0 to 1");
  CLI::App* dielectric = verb->add_subcommand("dielectric", "A smooth interface that reflects and transmits");
  dielectric->add_option("--ior", o->glass.ior, "Index of refraction below the surface over that above it, 0.1 to 10")
      ->type_name("N")
      ->required();
  dielectric->add_option("--channels", o->glass.channels, "How many")->type_name("N")->capture_default_str();
  for (CLI::App* kind : {lambert, ggx, mirror, dielectric}) {
    kind->add_option("-o,--output", o->output, "File to write")->type_name("OUT.brdfc")->required();
    kind->add_option("--wavelengths", o->wavelengths, "In nm, one per channel; without, 3 channels are RGB and 1 is a scalar")
        ->delimiter(',')
        ->type_name("A,B,..");
    kind->add_option("--name", o->name, "Name to store");
    kind->add_option("--licence", o->licence, "Licence to store");
    add_force(*kind, o->force);
    add_reporting(*kind, o->reporting, false);
  }
  verb->footer(
      "Every other verb takes such a file like any .brdfc. The parameters are stored as they are.\n\n"
      "Examples:\n"
      "  brdf-compress model lambert --albedo .5,.5,.5 -o grey.brdfc\n"
      "  brdf-compress model ggx --alpha-x .1 --alpha-y .4 --f0 .9,.7,.4 -o brushed.brdfc\n"
      "  brdf-compress model mirror --reflectance .95,.95,.95 -o mirror.brdfc\n"
      "  brdf-compress model dielectric --ior 1.5 -o glass.brdfc");
  return {verb, [=] {
            if (lambert->parsed()) return run(*o, Lambert{o->colour});
            if (mirror->parsed()) return run(*o, Mirror{o->colour});
            if (dielectric->parsed()) return run(*o, o->glass);
            const bool both = along->count() > 0 && across->count() > 0;
            if (o->alpha.has_value() ? along->count() + across->count() > 0 : !both)
              throw CLI::ValidationError("--alpha", "is wanted, or --alpha-x and --alpha-y");
            GgxReflector model = o->ggx;
            if (o->alpha) model.alpha_x = model.alpha_y = *o->alpha;
            model.f0 = o->colour;
            return run(*o, model);
          }};
}

}  // namespace brdf::cli
