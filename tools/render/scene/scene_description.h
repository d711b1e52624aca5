// SPDX-License-Identifier: Apache-2.0
// A scene as its file says it: plain data, checked, with nothing read yet of the files that it names. docs/scene_format.md
// describes the file.
#pragma once

#include "light/sky.h"
#include "light/lights.h"
#include "shape/generators.h"

#include <brdf/analytic.h>
#include <brdf/direction.h>
#include <brdf/material.h>
#include <brdf/measurement.h>

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace brdf::render {

struct CameraDescription {
  Vec3f position{0, 0, 5}, target{0}, up{0, 1, 0};
  float fov = 40;  ///< of the picture's height, degrees
};

struct FilmDescription {
  int width = 512, height = 512;
};

struct PathDescription {
  int max_depth = 32;      ///< vertices of a path after the camera; 1: direct light of what is emitted alone is not even reflected
  int roulette_depth = 4;  ///< vertices before Russian roulette begins
};

/// Which of the two directions is the incident one of a measured file, theta_i of RGL's.
enum class IncidentSide { light, viewer };

/// A measured or a compressed file, told apart by content; the first of `files` that is found is taken.
struct MaterialFile {
  std::vector<std::string> files;
  std::optional<std::uint64_t> prefix;             ///< read only these first bytes of a `.brdfc` file
  EvalLevel level = EvalLevel::balanced;           ///< of a `.brdfc` file
  SamplePosition position = SamplePosition::edge;  ///< of a MERL table
  IncidentSide incident = IncidentSide::light;     ///< of a measured file
};

struct MaterialDescription {
  std::string name, place;  ///< place: where in the scene file, for sentences
  std::variant<MaterialFile, AnalyticModel> what;
};

struct MeshFileShape { std::string file; };
struct SphereShape { Vec3f centre{0}; float radius = 1; };
struct QuadShape { Vec3f corner{-1, 0, 1}, edge_u{2, 0, 0}, edge_v{0, 0, -2}; };
struct BoxShape {};
struct LatheShape { std::vector<glm::vec2> profile; int segments = 128; };
struct BlobShape { int segments = 128; NoiseOptions noise; };
struct TerrainShape { int segments = 128; NoiseOptions noise; };

struct ShapeDescription {
  std::string place;
  std::variant<MeshFileShape, SphereShape, QuadShape, BoxShape, LatheShape, BlobShape, TerrainShape> what;
  std::uint32_t material = 0;     ///< index into the scene's materials
  std::optional<Vec3f> emission;  ///< radiance of the front side
  glm::mat4 transform{1};
  bool has_transform = false, flat = false;
};

struct EnvironmentMap { std::string file; float scale = 1, turn = 0; };
struct ConstantEnvironment { Vec3f radiance{1}; };
struct SkyEnvironment { SkyDescription sky; float turn = 0; };

struct EnvironmentDescription {
  std::string place;
  std::variant<ConstantEnvironment, EnvironmentMap, SkyEnvironment> what;  ///< turns in radians
};

struct SceneDescription {
  std::filesystem::path file;  ///< names in it are relative to its folder
  CameraDescription camera;
  FilmDescription film;
  PathDescription path;
  std::optional<EnvironmentDescription> environment;
  std::vector<DirectionalLight> lights;
  std::vector<MaterialDescription> materials;
  std::vector<ShapeDescription> shapes;
  std::vector<std::string> search;  ///< folders in which names of material files are looked for
};

/// What a scene file may ask for.
struct SceneLimits {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 24;
  std::uint64_t max_pixels = std::uint64_t{1} << 26;
  int max_side = 16384;
  std::size_t max_shapes = 65536, max_materials = 4096, max_lights = 4096;
  MeshLimits mesh;
};

/// Reads a scene file. Throws Error: io, malformed, limit_exceeded; the sentence names the file and the place in it,
/// "scene.json: shapes[2].material: no material is called 'gold'". Thread-safe.
SceneDescription read_scene(const std::filesystem::path& file, const SceneLimits& limits = {});

/// The same from text; `file` stands for the file in sentences and for the folder of relative names.
SceneDescription parse_scene(std::string_view text, const std::filesystem::path& file, const SceneLimits& limits = {});

}  // namespace brdf::render
