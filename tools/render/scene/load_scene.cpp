// SPDX-License-Identifier: Apache-2.0
#include "image/image_file.h"
#include "ingest/printable_text.h"
#include "scene/scene.h"

#include <brdf/error.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <mutex>
#include <numbers>
#include <thread>

namespace brdf::render {
namespace {

namespace fs = std::filesystem;

std::optional<Environment> load_environment(const SceneDescription& scene) {
  if (!scene.environment) return std::nullopt;
  const EnvironmentDescription& e = *scene.environment;
  return at_place(e.place, [&]() -> std::optional<Environment> {
    if (const auto* constant = std::get_if<ConstantEnvironment>(&e.what)) return Environment(constant->radiance);
    const auto* map = std::get_if<EnvironmentMap>(&e.what);
    return Environment(environment_picture(scene), map ? map->turn : std::get<SkyEnvironment>(e.what).turn);
  });
}

void load_shapes(Scene& scene, const SceneLimits& limits, std::vector<AreaLight>& lights) {
  std::uint64_t triangles = 0;
  for (const ShapeDescription& shape : scene.description.shapes) {
    at_place(shape.place, [&] {
      scene.material_of.push_back(shape.material);
      scene.light_of.push_back(no_index);
      if (const auto* sphere = std::get_if<SphereShape>(&shape.what)) {
        const SphereShape moved = transformed_sphere(*sphere, shape);
        scene.geometry.add_sphere(moved.centre, moved.radius);
        return;
      }
      const Mesh mesh = load_mesh(shape, scene.description.file.parent_path(), limits.mesh);
      triangles += mesh.triangles.size();
      if (triangles > limits.mesh.max_triangles) {
        throw Error(ErrorCode::limit_exceeded, "the scene has more than " + std::to_string(limits.mesh.max_triangles) + " triangles");
      }
      scene.geometry.add(mesh, shape.flat);
      if (!shape.emission || *shape.emission == Vec3f(0)) return;
      scene.light_of.back() = static_cast<std::uint32_t>(lights.size());
      AreaLight light;
      light.radiance = *shape.emission;
      for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) light.corners.push_back(mesh.positions[t[k]]);
      lights.push_back(std::move(light));
    });
  }
  scene.geometry.commit();
}

void load_slot(MaterialSlot& slot, const MaterialDescription& described, const LoadOptions& options,
               const std::vector<fs::path>& folders) {
  const auto other = options.materials.find(slot.name);
  const bool is_exchanged = other != options.materials.end();
  const std::string place = is_exchanged ? "material " + slot.name : described.place;
  at_place(place, [&] {
    if (const auto* model = std::get_if<AnalyticModel>(&described.what); model && !is_exchanged) {
      slot.source = name_of(*model);
      slot.surface = Surface::from_analytic(*model);
      return;
    }
    const MaterialFile& file = is_exchanged ? other->second : std::get<MaterialFile>(described.what);
    // what a user names counts from where the user is
    const fs::path path = is_exchanged ? fs::path(file.files.front()) : find_material(file, folders);
    slot.source = path.string();
    slot.surface = load_surface(path, file, slot.bytes);
  });
}

/// Loads the slots that shapes use, several at a time: compressing a table for its proposal takes most of it.
void load_materials(Scene& scene, const LoadOptions& options) {
  const auto& described = scene.description.materials;
  for (const MaterialDescription& m : described) scene.materials.push_back({m.name, "", 0, Surface(), false});
  for (const auto& [name, file] : options.materials) (void)scene.slot(name);
  for (const ShapeDescription& s : scene.description.shapes) scene.materials[s.material].used = true;

  const std::vector<fs::path> folders = material_folders(scene.description, options);
  std::vector<std::exception_ptr> failures(described.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < described.size(); i = next++) {
      if (!scene.materials[i].used) continue;
      try {
        load_slot(scene.materials[i], described[i], options, folders);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t count = std::min<std::size_t>(described.size(), std::max(1U, std::thread::hardware_concurrency()));
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& failure : failures)  // the first in the file's order, whichever came first in time
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

Camera::Camera(const CameraDescription& c, const FilmDescription& film) : position_(c.position) {
  const Vec3f view = glm::normalize(c.target - c.position), right = glm::normalize(glm::cross(view, c.up)), up = glm::cross(right, view);
  const float half_height = std::tan(0.5f * c.fov * std::numbers::pi_v<float> / 180), pixel = 2 * half_height / static_cast<float>(film.height);
  across_ = right * pixel;
  down_ = up * -pixel;
  corner_ = view - across_ * (0.5f * static_cast<float>(film.width)) + up * half_height;
}

Ray Camera::ray(float x, float y) const noexcept { return {position_, glm::normalize(corner_ + across_ * x + down_ * y)}; }

std::uint32_t check_slot(const SceneDescription& scene, std::string_view name) {
  std::string names;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name) return static_cast<std::uint32_t>(i);
    names += (names.empty() ? "" : ", ") + scene.materials[i].name;
  }
  throw Error(ErrorCode::invalid_argument, scene.file.string() + ": no material is called " + ingest::in_quotes(name) + ", there are: " + names);
}

std::uint32_t Scene::slot(std::string_view name) const { return check_slot(description, name); }

std::vector<fs::path> material_folders(const SceneDescription& scene, const LoadOptions& options) {
  std::vector<fs::path> folders{scene.file.parent_path()};
  if (options.search) {
    folders.insert(folders.end(), options.search->begin(), options.search->end());
  } else {
    for (const std::string& folder : scene.search) folders.push_back(scene.file.parent_path() / folder);
  }
  return folders;
}

Image environment_picture(const SceneDescription& scene) {
  const EnvironmentDescription& e = *scene.environment;
  if (const auto* sky = std::get_if<SkyEnvironment>(&e.what)) return make_sky(sky->sky);
  const auto& map = std::get<EnvironmentMap>(e.what);
  Image image = read_image(scene.file.parent_path() / map.file);
  if (image.width < 2 || image.height < 2) throw Error(ErrorCode::malformed, map.file + ": an environment needs 2 x 2 pixels");
  for (Vec3f& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = std::max(pixel[c] * map.scale, 0.0f);  // filters leave values below 0 behind
  return image;
}

SphereShape transformed_sphere(const SphereShape& sphere, const ShapeDescription& shape) {
  const glm::mat3 m(shape.transform);
  const float scale = glm::length(m[0]);
  for (int i = 0; i < 3; ++i) {
    const bool same = std::abs(glm::length(m[i]) - scale) <= 1e-4f * scale;
    const bool right_angle = std::abs(glm::dot(m[i], m[(i + 1) % 3])) <= 1e-4f * scale * scale;
    if (!same || !right_angle) throw Error(ErrorCode::malformed, "a sphere takes no transform that makes it an ellipsoid; use a blob");
  }
  return {Vec3f(shape.transform * glm::vec4(sphere.centre, 1)), sphere.radius * scale};
}

Scene load_scene(const SceneDescription& description, const LoadOptions& options) {
  Scene scene{description, Camera(description.camera, description.film), {}, {}, {}, {}, {}};
  load_materials(scene, options);
  std::vector<AreaLight> areas;
  load_shapes(scene, options.limits, areas);
  scene.lights = Lights(load_environment(description), std::move(areas), description.lights, scene.geometry.radius());
  return scene;
}

Scene load_scene(const fs::path& file, const LoadOptions& options) { return load_scene(read_scene(file, options.limits), options); }

}  // namespace brdf::render
