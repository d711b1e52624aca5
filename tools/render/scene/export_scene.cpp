// SPDX-License-Identifier: Apache-2.0
#include "scene/export_scene.h"

#include "base/file_io.h"
#include "image/image_file.h"
#include "shape/ply_writer.h"

#include <brdf/error.h>

#include <nlohmann/json.hpp>

#include <numbers>
#include <span>
#include <string>
#include <system_error>

namespace brdf::render {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json triple(const Vec3f& v) { return Json::array({v.x, v.y, v.z}); }

Json camera_json(const CameraDescription& c) {
  return {{"position", triple(c.position)}, {"target", triple(c.target)}, {"up", triple(c.up)}, {"fov", c.fov}};
}

struct ModelJson {
  Json operator()(const Lambert& m) const { return {{"type", "lambert"}, {"albedo", m.albedo}}; }
  Json operator()(const GgxReflector& m) const {
    return {{"type", "ggx"}, {"alpha_x", m.alpha_x}, {"alpha_y", m.alpha_y}, {"f0", m.f0}, {"multiple_scattering", m.multiple_scattering}};
  }
  Json operator()(const Mirror& m) const { return {{"type", "mirror"}, {"reflectance", m.reflectance}}; }
  Json operator()(const Dielectric& m) const { return {{"type", "dielectric"}, {"ior", m.ior}}; }
};

Json file_json(const MaterialFile& m, const fs::path& path) {
  Json json{{"type", "file"}, {"file", fs::absolute(path).lexically_normal().string()}};
  if (m.prefix) json["prefix"] = *m.prefix;
  json["eval"] = m.level == EvalLevel::fast ? "fast" : m.level == EvalLevel::balanced ? "balanced" : "exact";
  json["position"] = m.position == SamplePosition::edge ? "edge" : "centre";
  json["incident"] = m.incident == IncidentSide::light ? "light" : "viewer";
  return json;
}

Json materials_json(const SceneDescription& scene, const LoadOptions& options) {
  std::vector<bool> used(scene.materials.size());
  for (const ShapeDescription& shape : scene.shapes) used[shape.material] = true;
  const std::vector<fs::path> folders = material_folders(scene, options);
  Json json = Json::object();
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!used[i]) continue;
    const MaterialDescription& m = scene.materials[i];
    if (const auto other = options.materials.find(m.name); other != options.materials.end()) {
      json[m.name] = file_json(other->second, other->second.files.front());
    } else if (const auto* file = std::get_if<MaterialFile>(&m.what)) {
      at_place(m.place, [&] { json[m.name] = file_json(*file, find_material(*file, folders)); });
    } else {
      json[m.name] = std::visit(ModelJson{}, std::get<AnalyticModel>(m.what));
    }
  }
  return json;
}

Json environment_json(const SceneDescription& scene, const fs::path& folder, bool overwrite) {
  const EnvironmentDescription& e = *scene.environment;
  if (const auto* constant = std::get_if<ConstantEnvironment>(&e.what)) return {{"type", "constant"}, {"radiance", triple(constant->radiance)}};
  const auto* map = std::get_if<EnvironmentMap>(&e.what);
  const float turn = map ? map->turn : std::get<SkyEnvironment>(e.what).turn;
  write_exr(environment_picture(scene), folder / "environment.exr", {}, ExrPixels::float32, overwrite);
  return {{"type", "map"}, {"file", "environment.exr"}, {"rotation", turn * 180 / std::numbers::pi_v<float>}};
}

Json shape_json(const SceneDescription& scene, std::size_t i, const SceneLimits& limits, const fs::path& folder, bool overwrite) {
  const ShapeDescription& shape = scene.shapes[i];
  const std::string& material = scene.materials[shape.material].name;
  return at_place(shape.place, [&]() -> Json {
    if (const auto* sphere = std::get_if<SphereShape>(&shape.what)) {
      const SphereShape moved = transformed_sphere(*sphere, shape);
      return {{"type", "sphere"}, {"centre", triple(moved.centre)}, {"radius", moved.radius}, {"material", material}};
    }
    Mesh mesh = load_mesh(shape, scene.file.parent_path(), limits.mesh);
    if (mesh.normals.empty()) mesh.normals = smooth_normals(mesh);  // others weight them in their own way
    const std::string name = "shape_" + std::to_string(i) + ".ply";
    base::write_file_atomically(folder / name, write_ply(mesh), overwrite);
    Json json{{"type", "ply"}, {"file", name}, {"material", material}, {"flat", shape.flat}};
    if (shape.emission) json["emission"] = triple(*shape.emission);
    return json;
  });
}

}  // namespace

void export_scene(const SceneDescription& scene, const LoadOptions& options, const fs::path& folder, bool overwrite) {
  for (const auto& [name, file] : options.materials) check_slot(scene, name);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(ErrorCode::io, folder.string() + ": " + error.message());

  Json json;
  json["comment"] = "Exported from " + scene.file.filename().string();
  json["camera"] = camera_json(scene.camera);
  json["film"] = {{"width", scene.film.width}, {"height", scene.film.height}};
  json["path"] = {{"max_depth", scene.path.max_depth}, {"roulette_depth", scene.path.roulette_depth}};
  json["materials"] = materials_json(scene, options);
  if (scene.environment) json["environment"] = environment_json(scene, folder, overwrite);
  for (const DirectionalLight& light : scene.lights) {
    json["lights"].push_back({{"type", "directional"}, {"direction", triple(-light.to_light)}, {"irradiance", triple(light.irradiance)}});
  }
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) json["shapes"].push_back(shape_json(scene, i, options.limits, folder, overwrite));
  // last: whoever finds it finds what it names
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  base::write_file_atomically(folder / "scene.json", std::as_bytes(std::span(text.data(), text.size())), overwrite);
}

}  // namespace brdf::render
