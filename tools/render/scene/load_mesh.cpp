// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"
#include "scene/scene.h"
#include "shape/obj_reader.h"
#include "shape/ply_reader.h"

#include <brdf/error.h>

namespace brdf::render {
namespace {

Mesh read_mesh(const std::filesystem::path& path, const MeshLimits& limits) {
  const std::vector<std::byte> bytes = base::read_file(path, limits.max_file_bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // by content: a PLY file begins with its name
  const bool is_ply = text.starts_with("ply\n") || text.starts_with("ply\r");
  return is_ply ? read_ply(bytes, path.string(), limits) : read_obj(text, path.string(), limits);
}

struct MakeMesh {
  const std::filesystem::path& folder;
  const MeshLimits& limits;

  Mesh operator()(const MeshFileShape& s) const { return read_mesh(folder / s.file, limits); }
  Mesh operator()(const SphereShape&) const { return {}; }
  Mesh operator()(const QuadShape& s) const { return make_quad(s.corner, s.edge_u, s.edge_v); }
  Mesh operator()(const BoxShape&) const { return make_box(); }
  Mesh operator()(const LatheShape& s) const { return make_lathe(s.profile, s.segments); }
  Mesh operator()(const BlobShape& s) const { return make_blob(s.segments, s.noise); }
  Mesh operator()(const TerrainShape& s) const { return make_terrain(s.segments, s.noise); }
};

}  // namespace

Mesh load_mesh(const ShapeDescription& shape, const std::filesystem::path& folder, const MeshLimits& limits) {
  Mesh mesh = std::visit(MakeMesh{folder, limits}, shape.what);
  if (shape.has_transform) transform_mesh(mesh, shape.transform);
  check_mesh(mesh, "the mesh");
  return mesh;
}

}  // namespace brdf::render
