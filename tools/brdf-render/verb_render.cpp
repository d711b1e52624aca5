// SPDX-License-Identifier: Apache-2.0
#include <brdf/version.h>

#include "image/image_file.h"
#include "interrupt.h"
#include "messages.h"
#include "options.h"
#include "output_file.h"
#include "path/render_scene.h"
#include "progress_bar.h"
#include "render_report.h"
#include "scene_options.h"
#include "standard_output.h"
#include "stopwatch.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

using render::Sampling;

struct Options {
  SceneOptions scene;
  std::string output, png;
  render::RenderOptions render;
  float exposure = 0;
  bool force = false;
  Reporting reporting;
};

ExitCode run(const Options& o, const std::string& command_line) {
  for (const std::string& file : {o.output, o.png})
    if (!file.empty()) check_output(file, o.scene.file, o.force);
  if (!o.png.empty() && o.output == o.png) throw Failure(ExitCode::usage, o.png + ": both pictures have the same name");

  ProgressBar bar(o.reporting);
  bar.show("loading", 0);
  const Stopwatch loading;
  const render::Scene scene = open_scene(o.scene);
  const double load_seconds = loading.seconds();

  const DeferInterrupt interrupt;  // a signal ends the rendering, and the program once the pictures are written
  const render::RenderResult result = render::render_scene(scene, o.render, [&](std::string_view stage, double done) {
    bar.show(stage, done);
    return !interrupt.arrived();
  });
  bar.clear();
  const render::Image image = result.film.image();
  render::write_exr(image, o.output, picture_metadata(scene, o.render, result, command_line), render::ExrPixels::float32, o.force);
  if (!o.png.empty()) render::write_png(image, o.png, o.exposure, o.force);

  const Json row = render_row(scene, o.render, result, load_seconds);
  if (o.reporting.json) print(json_report("render", Json::array({row})));
  o.reporting.say(render_text(row, o.output));
  return ExitCode::ok;
}

}  // namespace

Verb add_render(CLI::App& program, const std::string& command_line) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("render", "Render a scene to an EXR picture; what is meant where no verb is named");
  add_scene(*verb, o->scene);
  verb->add_option("-o,--output", o->output, "Picture to write: OpenEXR, linear, with metadata")->required()->type_name("OUT.exr");
  verb->add_option("--png", o->png, "Also write it for a display: sRGB, 8 bits")->type_name("OUT.png");
  verb->add_option("--exposure", o->exposure, "Of the PNG, in stops: radiance is multiplied by 2^E")
      ->type_name("E")
      ->check(CLI::Range(-64.0, 64.0))
      ->capture_default_str();
  verb->add_option("--spp", o->render.spp, "Samples per pixel")->type_name("N")->check(CLI::Range(1, 1 << 20))->capture_default_str();
  verb->add_option("--time", o->render.seconds, "Begin no further pass after this many seconds; --spp is then the most")
      ->type_name("S")
      ->check(CLI::Range(0.0, 1e9));
  verb->add_option("--seed", o->render.seed, "Seed of the random numbers; the same seed gives the same picture")
      ->check(natural_number())
      ->capture_default_str();
  add_choice<Sampling>(*verb, "--sampling", o->render.sampling,
                       {{"mis", Sampling::mis},
                        {"bsdf", Sampling::bsdf},
                        {"light", Sampling::light},
                        {"cosine", Sampling::cosine},
                        {"lobes", Sampling::lobes}},
                       "Where directions come from: lights and materials, one of both, or mis with materials drawn by the cosine or by "
                       "their lobes alone (default mis)");
  add_threads(*verb, o->render.threads);
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting);
  verb->footer(
      "Ctrl-C stops the rendering and writes what there is.\n\n"
      "Examples:\n"
      "  brdf-render data/scenes/ball.json -o ball.exr --png ball.png --spp 256\n"
      "  brdf-render render data/scenes/ball.json -o ball.exr --material ball=gold.brdfc,eval=exact\n"
      "  brdf-render data/scenes/furnace.json -o furnace.exr --sampling bsdf --json");
  return {verb, [o, command_line] { return run(*o, command_line); }};
}

}  // namespace brdf::cli
