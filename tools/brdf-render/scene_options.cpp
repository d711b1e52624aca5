// SPDX-License-Identifier: Apache-2.0
#include "scene_options.h"

#include "exit_codes.h"
#include "options.h"

#include <charconv>

namespace brdf::cli {
namespace {

void take_setting(const std::string& setting, render::MaterialFile& material, const std::string& option) {
  const std::size_t equals = setting.find('=');
  const std::string key = setting.substr(0, equals), value = equals == std::string::npos ? "" : setting.substr(equals + 1);
  if (key == "eval") {
    if (value == "fast") material.level = EvalLevel::fast;
    else if (value == "balanced") material.level = EvalLevel::balanced;
    else if (value == "exact") material.level = EvalLevel::exact;
    else throw CLI::ValidationError(option, "eval is '" + value + "', allowed is fast, balanced or exact");
  } else if (key == "prefix") {
    std::uint64_t bytes = 0;
    const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), bytes);
    if (error != std::errc{} || rest != value.data() + value.size() || bytes == 0) {
      throw CLI::ValidationError(option, "prefix is '" + value + "', allowed is a whole number of at least 1");
    }
    material.prefix = bytes;
  } else if (key == "position") {
    if (value != "edge" && value != "centre") throw CLI::ValidationError(option, "position is '" + value + "', allowed is edge or centre");
    material.position = value == "edge" ? SamplePosition::edge : SamplePosition::centre;
  } else if (key == "incident") {
    if (value != "light" && value != "viewer") throw CLI::ValidationError(option, "incident is '" + value + "', allowed is light or viewer");
    material.incident = value == "light" ? render::IncidentSide::light : render::IncidentSide::viewer;
  } else {
    throw CLI::ValidationError(option, "'" + setting + "' is none of eval=LEVEL, prefix=BYTES, position=edge|centre and incident=light|viewer");
  }
}

}  // namespace

void add_scene(CLI::App& verb, SceneOptions& o) {
  verb.add_option("SCENE", o.file, "A scene file; docs/scene_format.md describes it")->required();
  verb.add_option("--material", o.materials,
                  "Material file to take for a slot, measured or .brdfc; repeatable. ,eval=LEVEL ,prefix=BYTES ,position=edge|centre "
                  ",incident=light|viewer may follow the name")
      ->type_name("SLOT=FILE")
      ->allow_extra_args(false);
  verb.add_option("--search", o.search, "Folder to look for material files in, instead of those that the scene names; repeatable")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
}

std::pair<std::string, render::MaterialFile> parse_material(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw CLI::ValidationError(option, "is '" + text + "', allowed is SLOT=FILE");
  }
  render::MaterialFile material;
  const std::vector<std::string> parts = split_list(text.substr(equals + 1));
  // a comma may also be part of the file's name
  std::size_t names = parts.size();
  while (names > 1 && parts[names - 1].find('=') != std::string::npos) --names;
  std::string file = parts[0];
  for (std::size_t i = 1; i < names; ++i) file += "," + parts[i];
  for (std::size_t i = names; i < parts.size(); ++i) take_setting(parts[i], material, option);
  material.files.push_back(file);
  return {text.substr(0, equals), material};
}

render::LoadOptions load_options(const SceneOptions& o) {
  render::LoadOptions load;
  for (const std::string& text : o.materials) {
    auto [slot, material] = parse_material(text, "--material");
    if (!load.materials.emplace(slot, std::move(material)).second) {
      throw CLI::ValidationError("--material", "names the slot '" + slot + "' twice");
    }
  }
  if (!o.search.empty()) load.search.emplace(o.search.begin(), o.search.end());
  return load;
}

render::Scene open_scene(const SceneOptions& o) {
  const render::LoadOptions load = load_options(o);
  try {
    return render::load_scene(o.file, load);
  } catch (const Error& e) {
    if (e.code() == ErrorCode::cancelled) throw;
    throw Failure(e.code() == ErrorCode::invalid_argument ? ExitCode::usage : ExitCode::bad_input, e.what());
  }
}

}  // namespace brdf::cli
