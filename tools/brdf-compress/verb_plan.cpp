// SPDX-License-Identifier: Apache-2.0
// Chooses what every measured material of a scene is held as, writes the files, and renders what came of it.
#include "image/comparison_sheet.h"
#include "image/image_file.h"
#include "output_file.h"
#include "plan_choice.h"
#include "plan_render.h"
#include "plan_report.h"
#include "plan_slots.h"
#include "profile_input.h"
#include "progress_bar.h"
#include "scene_options.h"
#include "standard_output.h"
#include "text_table.h"
#include "verb_options.h"
#include "verbs.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>

namespace brdf::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  SceneOptions scene;
  std::optional<std::uint64_t> budget;
  std::optional<double> flip, nanoseconds;
  std::string folder, preset = "fast", profile, png;
  std::vector<std::uint64_t> sizes;
  render::RenderOptions render;
  int profile_spp = 16;
  float exposure = 0;
  bool dry_run = false, force = false;
  Reporting reporting;
};

/// A name of its own for each slot's file.
std::vector<std::string> file_names(const std::vector<PlanSlot>& slots) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const PlanSlot& slot : slots) {
    std::string name = slot.name;
    for (char& c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
    while (!taken.insert(name).second) name += '_';
    names.push_back(name + ".brdfc");
  }
  return names;
}

PlanChoice choose(const Options& o, const render::Scene& scene, const std::vector<PlanSlot>& slots, const Progress& progress) {
  if (o.budget) return choose_by_bytes(slots, static_cast<double>(*o.budget));
  if (o.nanoseconds) return choose_by_time(slots, *o.nanoseconds);
  return choose_by_flip(scene, slots, *o.flip, o.render, o.exposure, progress);
}

void write_files(const Options& o, const std::vector<PlanSlot>& slots, const PlanChoice& choice, std::vector<PlannedFile>& files) {
  const std::vector<std::string> names = file_names(slots);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    files[i].file = (fs::path(o.folder) / names[i]).string();
    write_output(files[i].file, *slots[i].points[choice.point[i]].file, o.force);
  }
}

void write_sheet(const Options& o, const std::vector<PlanSlot>& slots, const PlanChoice& choice, const PlanPicture& picture) {
  render::SheetLabels labels;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    labels.reference.push_back(slots[i].name + ": " + fs::path(slots[i].source).filename().string());
    const TradePoint& p = slots[i].points[choice.point[i]];
    labels.candidate.push_back(slots[i].name + ": " + to_string(p.representation) + ", " + std::to_string(p.bytes) + " bytes");
  }
  render::write_png(render::comparison_sheet(picture.pair.reference, picture.pair.candidate, picture.result, labels, o.exposure), o.png, o.force);
}

ExitCode run(Options o) {
  if (static_cast<int>(o.budget.has_value()) + static_cast<int>(o.flip.has_value()) + static_cast<int>(o.nanoseconds.has_value()) != 1)
    throw Failure(ExitCode::usage, "exactly one of --budget, --target-flip and --target-ns must be given");
  if (!o.dry_run && o.folder.empty()) throw Failure(ExitCode::usage, "--output is missing: the folder for the files; --dry-run writes none");
  if (o.dry_run && o.flip) throw Failure(ExitCode::usage, "--target-flip is found by rendering, which --dry-run leaves out");
  if (!o.folder.empty() && !fs::is_directory(o.folder)) throw Failure(ExitCode::usage, o.folder + ": no such folder");
  if (!o.png.empty()) check_output(o.png, o.scene.file, o.force);

  ProgressBar bar(o.reporting);
  const auto stage = [&bar](const char* what) { return [&bar, what](std::string_view part, double done) {
    bar.show(std::string(what) + (part.empty() ? "" : ", " + std::string(part)), done);
    return true;
  }; };
  bar.show("loading", 0);
  const render::Scene scene = open_scene(o.scene);
  render::RenderOptions profiling = o.render;
  profiling.spp = o.profile_spp;
  const Profile profile = o.profile.empty() ? scene_profile(scene, profiling, stage("profile")) : read_profile(o.profile);
  std::vector<PlanSlot> slots = plan_slots(scene, profile);
  if (slots.empty()) throw Failure(ExitCode::bad_input, o.scene.file + ": no measured file reflects light in this scene, so there is nothing to plan");
  if (!o.folder.empty())
    for (const std::string& name : file_names(slots)) check_output(fs::path(o.folder) / name, o.scene.file, o.force);

  measure_trades(slots, {preset_effort(o.preset), thread_count(o.render.threads), o.sizes}, stage("trade"));
  const PlanChoice choice = choose(o, scene, slots, stage("plan"));
  std::vector<PlannedFile> files(slots.size());
  std::optional<PlanPicture> picture;
  if (!o.dry_run) {
    picture = render_plan(scene, slots, choice, o.render, o.exposure, stage("verifying"));
    render::RenderOptions quick = o.render;
    quick.spp = std::max(o.render.spp / 4, 2);
    for (std::size_t i = 0; i < slots.size(); ++i)
      files[i].flip = render_plan(scene, slots, choice, quick, o.exposure, stage(slots[i].name.c_str()), i).result.flip;
    write_files(o, slots, choice, files);
    if (!o.png.empty()) write_sheet(o, slots, choice, *picture);
  }
  bar.clear();
  const Json rows = plan_rows(o.scene.file, slots, choice, files, picture ? &*picture : nullptr);
  print(o.reporting.json ? json_report("plan", rows) : plan_text(rows));
  return ExitCode::ok;
}

}  // namespace

Verb add_plan(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("plan", "Choose what each measured material of a scene is held as, and render what came of it");
  add_scene(*verb, o->scene);
  verb->add_option("--budget", o->budget, "Bytes of all files together")->type_name("BYTES")->check(natural_number(1));
  verb->add_option("--target-flip", o->flip, "Fewest bytes with at most this FLIP between the pictures")->type_name("F")->check(CLI::Range(1e-6, 1.0));
  verb->add_option("--target-ns", o->nanoseconds, "Nanoseconds of an evaluation, the mean over those that the scene asks for")->type_name("N")->check(CLI::Range(0.1, 1e6));
  verb->add_option("-o,--output", o->folder, "Folder for the files SLOT.brdfc; it must exist")->type_name("FOLDER");
  verb->add_flag("--dry-run", o->dry_run, "Show the plan and what is expected of it; render nothing but the profile, write nothing");
  verb->add_option("--profile", o->profile, "What scenes asked, from brdf-render --profile; without it the scene is rendered for one")->type_name("P");
  verb->add_option("--profile-spp", o->profile_spp, "Samples per pixel of that rendering")->type_name("N")->check(CLI::Range(1, 1 << 16))->capture_default_str();
  verb->add_option("--preset", o->preset, "Encode time of each file that is tried")->check(CLI::IsMember(preset_names()))->capture_default_str();
  verb->add_option("--sizes", o->sizes, "Sizes of the files that are tried, bytes")->delimiter(',')->check(natural_number(48));
  verb->add_option("--spp", o->render.spp, "Samples per pixel of the renderings that verify")->type_name("N")->check(CLI::Range(2, 1 << 20))->capture_default_str();
  verb->add_option("--seed", o->render.seed, "Seed of the renderings")->check(natural_number())->capture_default_str();
  verb->add_option("--exposure", o->exposure, "Stops at which a display shows the pictures")->type_name("E")->check(CLI::Range(-64.0, 64.0))->capture_default_str();
  verb->add_option("--png", o->png, "Write reference, plan, signed difference and FLIP map as one picture")->type_name("OUT.png");
  add_threads(*verb, o->render.threads);
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting);
  verb->footer("Where a choice cannot meet a target nothing is written, and the best reachable value is said (exit code 4).\n\n"
               "Examples:\n"
               "  brdf-compress plan data/scenes/product.json --budget 3000 -o files\n"
               "  brdf-compress plan data/scenes/product.json --target-flip 0.005 -o files --png plan.png\n"
               "  brdf-compress plan data/scenes/product.json --target-ns 60 --dry-run");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
