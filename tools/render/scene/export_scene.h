// SPDX-License-Identifier: Apache-2.0
// A scene without anything that this renderer alone can make, for other renderers to read.
#pragma once

#include "scene/scene.h"

#include <filesystem>

namespace brdf::render {

/// Writes to `folder`, which is created where it is missing: `scene.json`, a scene file with every value in it and no generated
/// part; `shape_N.ply` for each shape that is no sphere, transformed, with normals; and `environment.exr`, 32 bits a channel, for
/// maps and skies. Material files are named by absolute paths and are not copied. The result renders to the same picture.
/// With `overwrite` false files that exist are left alone.
/// Throws Error with the place in the scene file, and io.
void export_scene(const SceneDescription& scene, const LoadOptions& options, const std::filesystem::path& folder, bool overwrite);

}  // namespace brdf::render
