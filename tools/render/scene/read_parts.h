// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file, each with what may stand in it.
#pragma once

#include "scene/json_place.h"
#include "scene/scene_description.h"

namespace brdf::render {

CameraDescription read_camera(const JsonPlace& p);
FilmDescription read_film(const JsonPlace& p, const SceneLimits& limits);
PathDescription read_path(const JsonPlace& p);
EnvironmentDescription read_environment(const JsonPlace& p);
DirectionalLight read_light(const JsonPlace& p);
MaterialDescription read_material(const std::string& name, const JsonPlace& p);
ShapeDescription read_shape(const JsonPlace& p, const std::vector<MaterialDescription>& materials, const SceneLimits& limits);
glm::mat4 read_transform(const JsonPlace& p);

}  // namespace brdf::render
