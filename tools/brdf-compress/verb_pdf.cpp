// SPDX-License-Identifier: Apache-2.0
#include "direction_planes.h"
#include "row_queries.h"
#include "sampling_density.h"
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
  const Material density = sampling_density(MaterialSource::open(o.material, o.source));
  DirectionPlanes in, view;
  const BatchEval pdf = [&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    in.assign(wi);
    view.assign(wo);
    density.pdf(in.span(), view.span(), out.data());
  };
  answer_rows(pdf, 1, o.format);
  return ExitCode::ok;
}

}  // namespace

Verb add_pdf(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("pdf", "Density with which 'sample' draws wi given wo, for rows on stdin");
  verb->add_option("MATERIAL", o->material, "A .brdfc or measured file")->required();
  add_row_format(*verb, o->format);
  add_eval_level(*verb, o->source.level);
  add_prefix(*verb, o->source.prefix);
  add_position(*verb, o->source.position);
  verb->footer(
      "stdin: rows of wi.x wi.y wi.z wo.x wo.y wo.z, as for 'eval'. stdout: density per solid angle of wi, one a row.\n"
      "A measured file is sampled by a few lobes that are fitted to it first.\n\n"
      "Examples:\n"
      "  echo 0,0,1,0.6,0,0.8 | brdf-compress pdf gold.brdfc\n"
      "  brdf-compress pdf gold.brdfc --format f32 < directions.f32 > densities.f32");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
