// SPDX-License-Identifier: Apache-2.0
// A scene in memory, ready to be rendered.
#pragma once

#include "image/image.h"
#include "light/lights.h"
#include "scene/geometry_store.h"
#include "scene/scene_description.h"
#include "surface/surface.h"

#include <brdf/error.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace brdf::render {

/// A perspective camera. Pixel (0, 0) is at the top left.
class Camera {
 public:
  Camera(const CameraDescription& camera, const FilmDescription& film);
  /// Ray through a point of the film, in pixels.
  Ray ray(float x, float y) const noexcept;

 private:
  Vec3f position_, across_, down_, corner_;
};

struct LoadOptions {
  SceneLimits limits;
  /// Material files to take instead of what the scene names, by slot.
  std::map<std::string, MaterialFile, std::less<>> materials;
  /// Folders to look for material files in, instead of the scene's own "search".
  std::optional<std::vector<std::filesystem::path>> search;
};

/// What became of a material slot.
struct MaterialSlot {
  std::string name;
  std::string source;              ///< path of the file, or the name of the analytic model
  std::uint64_t bytes = 0;         ///< read of the file; of a `.brdfc` file the prefix
  Surface surface;
  bool used = false;               ///< by a shape; only those are loaded
};

/// Immutable once loaded, and thread-safe.
struct Scene {
  SceneDescription description;
  Camera camera;
  GeometryStore geometry;
  Lights lights;
  std::vector<MaterialSlot> materials;
  std::vector<std::uint32_t> material_of;  ///< slot of each shape
  std::vector<std::uint32_t> light_of;     ///< area light of each shape; no_index: none

  /// Index of a slot. Throws Error(invalid_argument) with the names there are.
  std::uint32_t slot(std::string_view name) const;
};

/// Reads every file that the scene names, compresses proposals for measured tables (some seconds each, on all processors) and builds
/// the tree. Throws Error with the place in the scene file.
Scene load_scene(const SceneDescription& description, const LoadOptions& options = {});
Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

/// A material file as a surface; `bytes` becomes what was read of it. A measured file becomes a table with a proposal of its own, a `.brdfc`
/// file a material at its level. Throws Error with the file's name. Thread-safe.
Surface load_surface(const std::filesystem::path& path, const MaterialFile& options, std::uint64_t& bytes);

/// The first of `material.files` that exists: as it is where absolute, else in each of the folders.
/// Throws Error(io) that names the folders.
std::filesystem::path find_material(const MaterialFile& material, const std::vector<std::filesystem::path>& folders);

/// Folders in which the scene's material files are looked for.
std::vector<std::filesystem::path> material_folders(const SceneDescription& scene, const LoadOptions& options);

/// Throws Error(invalid_argument), with the names there are, where no material of the scene has this name. Returns its index.
std::uint32_t check_slot(const SceneDescription& scene, std::string_view name);

/// The scene's environment, a map or a sky, as the picture that lights it, before it is turned. Throws Error of read_image.
Image environment_picture(const SceneDescription& scene);

/// Centre and radius of a sphere after its transform, which must keep it one: throws Error(malformed).
SphereShape transformed_sphere(const SphereShape& sphere, const ShapeDescription& shape);

/// Runs `action`; what it throws gets the place in the scene file.
template <class Action>
auto at_place(const std::string& place, Action&& action) {
  try {
    return action();
  } catch (const Error& e) {
    throw Error(e.code(), place + ": " + e.what());
  }
}

/// The mesh that a description stands for, transformed and checked. Spheres have none.
Mesh load_mesh(const ShapeDescription& shape, const std::filesystem::path& folder, const MeshLimits& limits);

}  // namespace brdf::render
