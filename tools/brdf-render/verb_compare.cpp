// SPDX-License-Identifier: Apache-2.0
#include "comparison_report.h"
#include "image/comparison_sheet.h"
#include "image/image_file.h"
#include "interrupt.h"
#include "messages.h"
#include "options.h"
#include "output_file.h"
#include "path/paired_render.h"
#include "progress_bar.h"
#include "render_report.h"
#include "scene_options.h"
#include "standard_output.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  SceneOptions scene;
  std::vector<std::string> candidates;
  std::string png, exr_prefix;
  render::RenderOptions render;
  float exposure = 0;
  bool force = false;
  Reporting reporting;
};

/// What takes the place of a slot's material.
struct Exchange {
  std::uint32_t slot = 0;
  std::string file;  ///< as it was given, with what follows the name
  std::uint64_t bytes = 0;
};

std::string exr_name(const Options& o, const std::string& picture) { return o.exr_prefix + "-" + picture + ".exr"; }

void check_outputs(const Options& o) {
  if (!o.png.empty()) check_output(o.png, o.scene.file, o.force);
  if (o.exr_prefix.empty()) return;
  for (const char* picture : {"reference", "candidate", "difference", "flip"}) check_output(exr_name(o, picture), o.scene.file, o.force);
}

/// Loads the candidates into `surfaces`, which are those of the reference.
std::vector<Exchange> load_candidates(const Options& o, const render::Scene& scene, std::vector<render::Surface>& surfaces) {
  std::vector<Exchange> exchanges;
  for (const std::string& text : o.candidates) {
    const auto [name, material] = parse_material(text, "--candidate");
    Exchange exchange;
    try {
      exchange.slot = scene.slot(name);
    } catch (const Error& e) {
      throw Failure(ExitCode::usage, e.what());
    }
    const auto is_same = [&](const Exchange& e) { return e.slot == exchange.slot; };
    if (std::any_of(exchanges.begin(), exchanges.end(), is_same)) {
      throw CLI::ValidationError("--candidate", "names the slot '" + name + "' twice");
    }
    if (!scene.materials[exchange.slot].used) {
      throw Failure(ExitCode::usage, o.scene.file + ": no shape has the material '" + name + "', so it cannot be compared");
    }
    exchange.file = text.substr(name.size() + 1);
    try {
      surfaces[exchange.slot] = render::load_surface(material.files.front(), material, exchange.bytes);
    } catch (const Error& e) {
      throw Failure(e.code() == ErrorCode::invalid_argument ? ExitCode::usage : ExitCode::bad_input,
                    "candidate " + name + ": " + e.what());
    }
    exchanges.push_back(std::move(exchange));
  }
  return exchanges;
}

std::string bytes_text(std::uint64_t bytes) { return bytes > 0 ? " (" + std::to_string(bytes) + " bytes)" : ""; }

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"  // every caller passes a literal
#pragma GCC diagnostic ignored "-Wformat-security"
  std::snprintf(text.data(), text.size(), format, values...);
#pragma GCC diagnostic pop
  return text.data();
}

std::string run_text(const render::RenderResult& run, int spp) {
  return formatted("%d samples per pixel, %.2f s, %.0f ns per vertex", spp, run.seconds, run.ns_per_vertex());
}

Json run_json(const render::RenderResult& run) {
  return {{"seconds", run.seconds}, {"vertices", run.counts.vertices}, {"ns_per_vertex", run.ns_per_vertex()}};
}

Json json_row(const Options& o, const render::Scene& scene, const std::vector<Exchange>& exchanges,
              const render::PairedRender& pair, const render::ComparisonResult& result) {
  Json row;
  row["scene"] = o.scene.file;
  row["width"] = pair.reference.width;
  row["height"] = pair.reference.height;
  row["spp"] = pair.spp;
  row["complete"] = pair.complete;
  row["seed"] = o.render.seed;
  row["exposure"] = o.exposure;
  row["threads"] = pair.reference_run.threads;
  row["candidates"] = Json::array();
  for (const Exchange& e : exchanges) {
    const render::MaterialSlot& slot = scene.materials[e.slot];
    row["candidates"].push_back({{"slot", slot.name},
                                 {"reference", slot.source},
                                 {"reference_bytes", slot.bytes},
                                 {"candidate", e.file},
                                 {"candidate_bytes", e.bytes}});
  }
  row["reference_run"] = run_json(pair.reference_run);
  row["candidate_run"] = run_json(pair.candidate_run);
  add_comparison(row, result);
  return row;
}

/// Slot by slot what it was and what is compared, and the runs.
std::string heading(const render::Scene& scene, const std::vector<Exchange>& exchanges, const render::PairedRender& pair) {
  std::string text;
  for (const Exchange& e : exchanges) {
    const render::MaterialSlot& slot = scene.materials[e.slot];
    text += slot.name + ": " + slot.source + bytes_text(slot.bytes) + " -> " + e.file + bytes_text(e.bytes) + '\n';
  }
  text += "reference: " + run_text(pair.reference_run, pair.spp) + '\n';
  text += "candidate: " + run_text(pair.candidate_run, pair.spp) + '\n';
  if (!pair.complete) text += "interrupted: the figures are of the samples that there were\n";
  return text + '\n';
}

render::SheetLabels labels(const render::Scene& scene, const std::vector<Exchange>& exchanges, const render::PairedRender& pair) {
  const auto file_name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  render::SheetLabels result;
  for (const Exchange& e : exchanges) {
    const render::MaterialSlot& slot = scene.materials[e.slot];
    result.reference.push_back(slot.name + ": " + file_name(slot.source) + bytes_text(slot.bytes));
    result.candidate.push_back(slot.name + ": " + file_name(e.file) + bytes_text(e.bytes));
  }
  const auto add_run = [&](std::vector<std::string>& lines, const render::RenderResult& run) {
    lines.push_back(formatted("%d spp, %.2f s, %.0f ns/vertex", pair.spp, run.seconds, run.ns_per_vertex()));
  };
  add_run(result.reference, pair.reference_run);
  add_run(result.candidate, pair.candidate_run);
  return result;
}

render::Image as_image(const render::Plane& plane) {
  render::Image image(plane.width, plane.height);
  for (std::size_t i = 0; i < plane.values.size(); ++i) image.pixels[i] = Vec3f(plane.values[i]);
  return image;
}

void write_pictures(const Options& o, const render::Scene& scene, const std::vector<Exchange>& exchanges,
                    const render::PairedRender& pair, const render::ComparisonResult& result, const std::string& command_line) {
  if (!o.png.empty()) {
    const render::SheetLabels lines = labels(scene, exchanges, pair);
    render::write_png(render::comparison_sheet(pair.reference, pair.candidate, result, lines, o.exposure), o.png, o.force);
  }
  if (o.exr_prefix.empty()) return;
  render::Metadata metadata = picture_metadata(scene, o.render, pair.reference_run, command_line);
  render::write_exr(pair.reference, exr_name(o, "reference"), metadata, render::ExrPixels::float32, o.force);
  std::string materials;
  for (const Exchange& e : exchanges) materials += (materials.empty() ? "" : "\n") + scene.materials[e.slot].name + "=" + e.file;
  metadata["brdfCandidates"] = materials;
  metadata["brdfSeconds"] = static_cast<float>(pair.candidate_run.seconds);
  render::write_exr(pair.candidate, exr_name(o, "candidate"), metadata, render::ExrPixels::float32, o.force);
  render::write_exr(result.difference, exr_name(o, "difference"), metadata, render::ExrPixels::float32, o.force);
  render::write_exr(as_image(result.flip_map), exr_name(o, "flip"), metadata, render::ExrPixels::float32, o.force);
}

ExitCode run(const Options& o, const std::string& command_line) {
  check_outputs(o);
  ProgressBar bar(o.reporting);
  bar.show("loading", 0);
  const render::Scene scene = open_scene(o.scene);
  std::vector<render::Surface> reference = render::surfaces_for(scene, render::Sampling::mis), candidate = reference;
  const std::vector<Exchange> exchanges = load_candidates(o, scene, candidate);
  std::vector<std::uint32_t> slots;
  for (const Exchange& e : exchanges) slots.push_back(e.slot);
  render::share_proposals(reference, candidate, slots);

  const DeferInterrupt interrupt;  // a signal ends the rendering, and the program once the pictures are written
  const render::PairedRender pair =
      render::render_pair(scene, reference, candidate, o.render, [&](std::string_view stage, double done) {
        bar.show(stage, done);
        return !interrupt.arrived();
      });
  bar.show("comparing", 1);
  const render::ComparisonResult result = render::compare_images(pair.reference, pair.candidate, pair.noise, o.exposure);
  bar.clear();
  write_pictures(o, scene, exchanges, pair, result, command_line);
  print(o.reporting.json ? json_report("compare", Json::array({json_row(o, scene, exchanges, pair, result)}))
                         : heading(scene, exchanges, pair) + comparison_table(result));
  return ExitCode::ok;
}

}  // namespace

Verb add_compare(CLI::App& program, const std::string& command_line) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("compare", "What changes in a picture when materials are exchanged, beside its noise");
  add_scene(*verb, o->scene);
  verb->add_option("--candidate", o->candidates,
                   "Material file to compare with what the scene has in a slot; repeatable, one slot each, written as for --material")
      ->required()
      ->type_name("SLOT=FILE")
      ->allow_extra_args(false);
  verb->add_option("--png", o->png, "Write reference, candidate, signed difference and FLIP map as one picture")->type_name("OUT.png");
  verb->add_option("--exr-prefix", o->exr_prefix, "Write P-reference.exr, P-candidate.exr, P-difference.exr and P-flip.exr")->type_name("P");
  verb->add_option("--exposure", o->exposure, "Stops at which a display shows the pictures: radiance is multiplied by 2^E")
      ->type_name("E")
      ->check(CLI::Range(-64.0, 64.0))
      ->capture_default_str();
  verb->add_option("--spp", o->render.spp, "Samples per pixel of each picture, half of them for the noise's second half; even")
      ->type_name("N")
      ->check(CLI::Range(2, 1 << 20))
      ->capture_default_str();
  verb->add_option("--seed", o->render.seed, "Seed of the random numbers; the same seed gives the same pictures")
      ->check(natural_number())
      ->capture_default_str();
  add_threads(*verb, o->render.threads);
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting);
  verb->footer(
      "Both pictures follow the same paths from the same random numbers, so most of their noise cancels. The noise floor is what a\n"
      "figure would be if only what is left of the noise differed, from two independent halves of the samples.\n"
      "Ctrl-C stops the rendering, and tells and writes what there is.\n\n"
      "Examples:\n"
      "  brdf-render compare data/scenes/ball.json --candidate ball=gold.brdfc --png gold.png\n"
      "  brdf-render compare data/scenes/ball.json --material ball=gold.binary --candidate ball=gold.brdfc,eval=fast --spp 256 --json");
  return {verb, [o, command_line] { return run(*o, command_line); }};
}

}  // namespace brdf::cli
