// SPDX-License-Identifier: Apache-2.0
#include "messages.h"
#include "options.h"
#include "scene/export_scene.h"
#include "scene_options.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  SceneOptions scene;
  std::string output;
  bool force = false;
  Reporting reporting;
};

ExitCode run(const Options& o) {
  const render::LoadOptions load = load_options(o.scene);
  render::SceneDescription scene;
  try {
    scene = render::read_scene(o.scene.file);
    for (const auto& [slot, file] : load.materials) (void)render::check_slot(scene, slot);
  } catch (const Error& e) {
    throw Failure(e.code() == ErrorCode::invalid_argument ? ExitCode::usage : ExitCode::bad_input, e.what());
  }
  render::export_scene(scene, load, o.output, o.force);
  o.reporting.say(o.output + ": " + std::to_string(scene.shapes.size()) + " shapes");
  return ExitCode::ok;
}

}  // namespace

Verb add_export(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("export", "Write a scene with its shapes as PLY files and its environment as a picture");
  add_scene(*verb, o->scene);
  verb->add_option("-o,--output", o->output, "Folder to write to; it is made where there is none")->required()->type_name("FOLDER");
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting, false);
  verb->footer(
      "For other renderers: FOLDER/scene.json has every value in it and names nothing that is generated. Material files are named by\n"
      "absolute paths and not copied. It renders to the same picture.\n\n"
      "Examples:\n"
      "  brdf-render export data/scenes/ball.json -o ball\n"
      "  brdf-render export data/scenes/ball.json -o ball -f --material ball=gold.bsdf,incident=viewer");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
