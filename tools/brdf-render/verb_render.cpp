// SPDX-License-Identifier: Apache-2.0
#include <brdf/version.h>

#include "image/image_file.h"
#include "interrupt.h"
#include "messages.h"
#include "options.h"
#include "output_file.h"
#include "path/profile_observer.h"
#include "path/render_scene.h"
#include "progress_bar.h"
#include "render_report.h"
#include "scene_options.h"
#include "standard_output.h"
#include "stopwatch.h"
#include "verbs.h"

#include <charconv>
#include <memory>
#include <optional>
#include <sstream>

namespace brdf::cli {
namespace {

using render::Sampling;

struct Options {
  SceneOptions scene;
  std::string output, png, profile;
  render::RenderOptions render;
  float exposure = 0;
  bool force = false;
  Reporting reporting;
};

/// CLI11's Range takes what is no number for one in it.
CLI::Validator within(double least, double most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && rest == text.data() + text.size() && value >= least && value <= most) return {};
    std::ostringstream sentence;
    sentence << "is '" << text << "', allowed is a number from " << least << " to " << most;
    return sentence.str();
  };
  return {check, ""};
}

ExitCode run(const Options& o, const std::string& command_line) {
  for (const std::string& file : {o.output, o.png, o.profile})
    if (!file.empty()) check_output(file, o.scene.file, o.force);
  if (!o.png.empty() && o.output == o.png) throw Failure(ExitCode::usage, o.png + ": both pictures have the same name");
  if (o.output.empty() && o.profile.empty()) throw Failure(ExitCode::usage, "--output or --profile is missing: there is nothing to write");

  ProgressBar bar(o.reporting);
  bar.show("loading", 0);
  const Stopwatch loading;
  const render::Scene scene = open_scene(o.scene);
  const double load_seconds = loading.seconds();

  std::optional<render::ProfileObservers> recorders;
  if (!o.profile.empty()) recorders.emplace(scene, o.render);
  const DeferInterrupt interrupt;  // a signal ends the rendering, and the program once the pictures are written
  const auto progress = [&](std::string_view stage, double done) {
    bar.show(stage, done);
    return !interrupt.arrived();
  };
  const render::RenderResult result = render::render_scene(scene, o.render, progress, {}, recorders ? recorders->observers() : std::span<render::PathObserver* const>());
  bar.clear();
  const render::Image image = result.film.image();
  if (!o.output.empty())
    render::write_exr(image, o.output, picture_metadata(scene, o.render, result, command_line), render::ExrPixels::float32, o.force);
  if (recorders) write_output(o.profile, recorders->profile().write(), o.force);
  if (!o.png.empty()) render::write_png(image, o.png, o.exposure, o.force);

  const Json row = render_row(scene, o.render, result, load_seconds);
  if (o.reporting.json) print(json_report("render", Json::array({row})));
  o.reporting.say(render_text(row, o.output.empty() ? o.profile : o.output));
  return ExitCode::ok;
}

}  // namespace

Verb add_render(CLI::App& program, const std::string& command_line) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("render", "Render a scene to an EXR picture; what is meant where no verb is named");
  add_scene(*verb, o->scene);
  verb->add_option("-o,--output", o->output, "Picture to write: OpenEXR, linear, with metadata")->type_name("OUT.exr");
  verb->add_option("--profile", o->profile, "Also record what the scene asks of its materials, for 'brdf-compress compress --profile'")->type_name("OUT.prof");
  verb->add_option("--png", o->png, "Also write it for a display: sRGB, 8 bits")->type_name("OUT.png");
  verb->add_option("--exposure", o->exposure, "Of the PNG, in stops: radiance is multiplied by 2^E")
      ->type_name("E")
      ->check(within(-64, 64))
      ->capture_default_str();
  verb->add_option("--spp", o->render.spp, "Samples per pixel")->type_name("N")->check(CLI::Range(1, 1 << 20))->capture_default_str();
  verb->add_option("--time", o->render.seconds, "Begin no further pass after this many seconds; --spp is then the most")
      ->type_name("S")
      ->check(within(0, 1e9));
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
      "  brdf-render data/scenes/product.json --profile product.prof --spp 32\n"
      "  brdf-render data/scenes/furnace.json -o furnace.exr --sampling bsdf --json");
  return {verb, [o, command_line] { return run(*o, command_line); }};
}

}  // namespace brdf::cli
