// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"
#include "ingest/printable_text.h"
#include "scene/read_parts.h"

#include <algorithm>
#include <string>

namespace brdf::render {
namespace {

using Json = nlohmann::ordered_json;

/// Parses, and says line and column where that fails. A key that stands twice in an object is refused: which of the two
/// counts would be anyone's guess.
Json parse(std::string_view text, const std::string& file) {
  std::vector<std::vector<std::string>> open;
  std::string twice;
  const auto watch = [&open, &twice](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key) {
      const std::string key = value.get<std::string>();
      auto& keys = open.back();
      if (std::find(keys.begin(), keys.end(), key) != keys.end() && twice.empty()) twice = key;
      keys.push_back(key);
    }
    return true;
  };
  try {
    Json document = Json::parse(text.begin(), text.end(), watch);
    if (!twice.empty()) throw Error(ErrorCode::malformed, file + ": the key " + ingest::in_quotes(twice) + " stands twice in one object");
    return document;
  } catch (const Json::parse_error& e) {
    const std::size_t at = std::min(e.byte > 0 ? e.byte - 1 : 0, text.size());
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    throw Error(ErrorCode::malformed, file + ":" + std::to_string(line) + ":" + std::to_string(at - line_start + 1) + ": no valid JSON here");
  } catch (const Json::exception& e) {  // a number that does not fit
    throw Error(ErrorCode::malformed, file + ": no valid JSON: " + ingest::printable_text(e.what(), 200));
  }
}

}  // namespace

SceneDescription parse_scene(std::string_view text, const std::filesystem::path& file, const SceneLimits& limits) {
  const std::string name = file.string();
  const Json document = parse(text, name);
  const JsonPlace root(document, name);
  root.allow({"camera", "film", "path", "environment", "lights", "materials", "shapes", "search", "comment"});
  SceneDescription scene;
  scene.file = file;
  scene.camera = read_camera(root.at("camera"));
  scene.film = read_film(root.at("film"), limits);
  if (const auto p = root.find("comment")) (void)p->text();
  if (const auto p = root.find("path")) scene.path = read_path(*p);
  if (const auto p = root.find("environment")) scene.environment = read_environment(*p);
  if (const auto p = root.find("lights")) {
    const auto all = p->elements();
    if (all.size() > limits.max_lights) p->fail("has " + std::to_string(all.size()) + " lights, the limit is " + std::to_string(limits.max_lights), ErrorCode::limit_exceeded);
    for (const JsonPlace& light : all) scene.lights.push_back(read_light(light));
  }
  if (const auto p = root.find("search"))
    for (const JsonPlace& folder : p->elements()) scene.search.push_back(folder.text());
  const JsonPlace materials = root.at("materials");
  const auto slots = materials.members();
  if (slots.size() > limits.max_materials) materials.fail("has " + std::to_string(slots.size()) + " materials, the limit is " + std::to_string(limits.max_materials), ErrorCode::limit_exceeded);
  for (const auto& [slot, p] : slots) {
    if (slot.empty()) materials.fail("a material has no name");
    scene.materials.push_back(read_material(slot, p));
  }
  const JsonPlace shapes = root.at("shapes");
  const auto all = shapes.elements();
  if (all.empty()) shapes.fail("the scene has no shape");
  if (all.size() > limits.max_shapes) shapes.fail("has " + std::to_string(all.size()) + " shapes, the limit is " + std::to_string(limits.max_shapes), ErrorCode::limit_exceeded);
  for (const JsonPlace& p : all) scene.shapes.push_back(read_shape(p, scene.materials, limits));
  const bool emits = std::any_of(scene.shapes.begin(), scene.shapes.end(), [](const ShapeDescription& s) { return s.emission.has_value(); });
  if (!scene.environment && scene.lights.empty() && !emits) {
    root.fail("nothing emits light: it has no environment, no lights and no shape with emission");
  }
  return scene;
}

SceneDescription read_scene(const std::filesystem::path& file, const SceneLimits& limits) {
  const std::vector<std::byte> bytes = base::read_file(file, limits.max_file_bytes);
  return parse_scene({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, limits);
}

}  // namespace brdf::render
