// SPDX-License-Identifier: Apache-2.0
// What is said about a rendering: in the picture, as JSON, as text.
#pragma once

#include "image/image_file.h"
#include "json_report.h"
#include "path/render_scene.h"

#include <string>

namespace brdf::cli {

render::Metadata picture_metadata(const render::Scene& scene, const render::RenderOptions& options, const render::RenderResult& result,
                                  const std::string& command_line);
Json render_row(const render::Scene& scene, const render::RenderOptions& options, const render::RenderResult& result, double load_seconds);
/// Two lines for people, made of the row.
std::string render_text(const Json& row, const std::string& output);

}  // namespace brdf::cli
