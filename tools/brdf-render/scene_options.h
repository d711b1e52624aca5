// SPDX-License-Identifier: Apache-2.0
// Options of every verb that loads a scene.
#pragma once

#include "scene/scene.h"

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace brdf::cli {

struct SceneOptions {
  std::string file;
  std::vector<std::string> materials;  ///< SLOT=FILE[,eval=LEVEL][,prefix=BYTES][,position=edge|centre][,incident=light|viewer]
  std::vector<std::string> search;
};

/// Adds SCENE, --material and --search.
void add_scene(CLI::App& verb, SceneOptions& options);

/// What "SLOT=FILE,..." means. Throws CLI::ValidationError that begins with `option`.
std::pair<std::string, render::MaterialFile> parse_material(const std::string& text, const std::string& option);

/// What --material and --search mean. Throws CLI::ValidationError.
render::LoadOptions load_options(const SceneOptions& options);

/// Loads it. Whatever cannot be read is Failure(bad_input), a material for a slot that is none Failure(usage).
render::Scene open_scene(const SceneOptions& options);

}  // namespace brdf::cli
