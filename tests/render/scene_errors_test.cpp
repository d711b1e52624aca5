// SPDX-License-Identifier: Apache-2.0
// What is wrong with a scene is said in one sentence that names the place.
#include "rendered_scene.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

#include <fstream>

namespace brdf::render::test {
namespace {

using brdf::test::expect_error;
using brdf::test::TemporaryFolder;

const std::string camera = R"("camera": {"position": [0, 0, 5], "target": [0, 0, 0]})", film = R"("film": {"width": 4, "height": 4})",
                  light = R"("environment": {"type": "constant", "radiance": 1})", materials = R"("materials": {"m": {"type": "lambert", "albedo": 0.5}})",
                  shapes = R"("shapes": [{"type": "sphere", "material": "m"}])";

std::string scene_with(const std::string& a, const std::string& b, const std::string& c, const std::string& d, const std::string& e) {
  return "{" + a + "," + b + "," + c + "," + d + "," + e + "}";
}
std::string with_shape(const std::string& shape) { return scene_with(camera, film, light, materials, R"("shapes": [{"type": "sphere", "material": "m"}, )" + shape + "]"); }
std::string with_material(const std::string& material) { return scene_with(camera, film, light, R"("materials": {"m": )" + material + "}", shapes); }

struct Case {
  std::string text;
  std::vector<const char*> words;
};

void expect_refused(const Case& c) {
  SCOPED_TRACE(c.text);
  try {
    (void)load_scene(parse_scene(c.text, "dir/scene.json"));
    ADD_FAILURE() << "was taken";
  } catch (const Error& e) {
    const std::string sentence = e.what();
    EXPECT_TRUE(sentence.starts_with("dir/scene.json")) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_LT(sentence.size(), 400U) << sentence;
    for (const char* word : c.words) EXPECT_NE(sentence.find(word), std::string::npos) << "'" << word << "' is not in: " << sentence;
  }
}

TEST(SceneErrors, AGoodSceneIsTaken) {
  const Scene scene = scene_of(scene_with(camera, film, light, materials, shapes));
  EXPECT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.slot("m"), 0U);
  expect_error(ErrorCode::invalid_argument, {"'x'", "m"}, [&] { (void)scene.slot("x"); });
}

TEST(SceneErrors, ThePlaceIsNamed) {
  const std::vector<Case> cases{
      {"", {"scene.json:1:1"}},
      {"{\n  \"camera\": nan\n}", {"scene.json:2:", "JSON"}},
      {"[]", {"array", "object"}},
      {"{}", {"'camera'", "missing"}},
      {scene_with(camera, film, light, materials, R"("shapes": [{"type": "sphere", "material": "gold"}])"), {"shapes[0].material", "'gold'"}},
      {scene_with(camera, film, light, materials, R"("shapes": [])"), {"shapes", "no shape"}},
      {scene_with(camera, film, R"("comment": "dark")", materials, shapes), {"light"}},
      {scene_with(camera, film, light, materials, shapes + R"(, "lamps": [])"), {"'lamps'", "allowed"}},
      {scene_with(camera, film, light, materials, shapes + "," + film), {"'film'", "twice"}},
      {scene_with(R"("camera": {"position": [0, 0, 5], "target": [0, 0, 5]})", film, light, materials, shapes), {"camera.target"}},
      {scene_with(R"("camera": {"position": [0, 0, 5], "target": [0, 0, 0], "up": [0, 0, 1]})", film, light, materials, shapes), {"camera", "up"}},
      {scene_with(R"("camera": {"position": [0, 0], "target": [0, 0, 0]})", film, light, materials, shapes), {"camera.position", "2 elements"}},
      {scene_with(R"("camera": {"position": [0, 0, "5"], "target": [0, 0, 0]})", film, light, materials, shapes), {"camera.position[2]", "string"}},
      {scene_with(R"("camera": {"position": [0, 0, 1e999], "target": [0, 0, 0]})", film, light, materials, shapes), {"1e999"}},
      {scene_with(camera, R"("film": {"width": 0, "height": 4})", light, materials, shapes), {"film.width", "0"}},
      {scene_with(camera, R"("film": {"width": 4.5, "height": 4})", light, materials, shapes), {"film.width", "4.5"}},
      {scene_with(camera, R"("film": {"width": 18446744073709551615, "height": 4})", light, materials, shapes), {"film.width"}},
      {scene_with(camera, R"("film": {"width": 16384, "height": 16384})", light, materials, shapes), {"film", "pixels"}},
      {scene_with(camera, film, R"("environment": {"type": "fog"})", materials, shapes), {"environment.type", "'fog'", "map"}},
      {scene_with(camera, film, R"("environment": {"type": "constant", "radiance": -1})", materials, shapes), {"environment.radiance", "-1"}},
      {scene_with(camera, film, R"("environment": {"type": "map", "file": "none.exr"})", materials, shapes), {"environment", "none.exr", "No such file"}},
      {scene_with(camera, film, R"("lights": [{"type": "directional", "direction": [0, 0, 0], "irradiance": 1}])", materials, shapes), {"lights[0].direction", "zero"}},
      {with_material(R"({"type": "gold"})"), {"materials.m.type", "'gold'"}},
      {with_material(R"({"type": "lambert", "albedo": 1.5})"), {"materials.m.albedo", "1.5"}},
      {with_material(R"({"type": "lambert", "albedo": 0.5, "colour": 1})"), {"materials.m", "'colour'"}},
      {with_material(R"({"type": "ggx", "f0": 0.5})"), {"materials.m", "alpha"}},
      {with_material(R"({"type": "file", "file": "none.binary"})"), {"materials.m", "none.binary", "dir"}},
      {with_material(R"({"type": "file", "file": []})"), {"materials.m.file"}},
      {with_material(R"({"type": "file", "file": "a", "prefix": -3})"), {"materials.m.prefix", "-3"}},
      {with_material(R"({"type": "dielectric", "ior": 0})"), {"materials.m.ior", "0.1"}},
      {with_shape(R"({"type": "cube", "material": "m"})"), {"shapes[1].type", "'cube'"}},
      {with_shape(R"({"type": "obj", "material": "m", "file": "none.obj"})"), {"shapes[1]", "none.obj", "No such file"}},
      {with_shape(R"({"type": "sphere", "material": "m", "radius": 0})"), {"shapes[1].radius"}},
      {with_shape(R"({"type": "sphere", "material": "m", "emission": 1})"), {"shapes[1]", "'emission'"}},
      {with_shape(R"({"type": "sphere", "material": "m", "transform": [{"scale": [1, 2, 1]}]})"), {"shapes[1]", "ellipsoid"}},
      {with_shape(R"({"type": "box", "material": "m", "transform": [{"scale": 0}]})"), {"shapes[1].transform[0].scale"}},
      {with_shape(R"({"type": "box", "material": "m", "transform": [{"rotate": [0, 1, 0]}]})"), {"shapes[1].transform[0]", "degrees"}},
      {with_shape(R"({"type": "quad", "material": "m", "edge_u": [1, 0, 0], "edge_v": [2, 0, 0]})"), {"shapes[1]", "area"}},
      {with_shape(R"({"type": "lathe", "material": "m", "profile": [[0, 0]]})"), {"shapes[1].profile", "points"}},
      {with_shape(R"({"type": "lathe", "material": "m", "profile": [[0, 0], [0, 1]]})"), {"shapes[1]", "no triangle"}},
      {with_shape(R"({"type": "blob", "material": "m", "segments": 1000000})"), {"shapes[1].segments", "1000000"}},
      {with_shape(R"({"material": "m"})"), {"shapes[1]", "'type'"}},
      {with_shape("7"), {"shapes[1]", "number"}},
  };
  for (const Case& c : cases) expect_refused(c);
}

TEST(SceneErrors, AMissingSceneFileIsNamed) {
  expect_error(ErrorCode::io, {"no/such/scene.json", "No such file"}, [] { (void)load_scene(std::filesystem::path("no/such/scene.json")); });
}

TEST(SceneErrors, FilesAreFoundBesideTheScene) {
  const TemporaryFolder folder;
  std::ofstream(folder / "t.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder / "bad.obj") << "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n";
  const auto text = [](const char* file) { return with_shape(std::string(R"({"type": "obj", "material": "m", "file": ")") + file + "\"}"); };
  EXPECT_EQ(load_scene(parse_scene(text("t.obj"), folder / "scene.json")).geometry.triangles(), 1U);
  expect_error(ErrorCode::malformed, {"shapes[1]", "bad.obj:2", "'nan'"}, [&] { (void)load_scene(parse_scene(text("bad.obj"), folder / "scene.json")); });
}

TEST(SceneErrors, ExchangedMaterialsMustHaveASlotAndAFile) {
  const SceneDescription scene = parse_scene(scene_with(camera, film, light, materials, shapes), "scene.json");
  LoadOptions options;
  options.materials["n"] = MaterialFile{{"a.brdfc"}, {}, {}, {}};
  expect_error(ErrorCode::invalid_argument, {"'n'", "m"}, [&] { (void)load_scene(scene, options); });
  options.materials.clear();
  options.materials["m"] = MaterialFile{{"none.brdfc"}, {}, {}, {}};
  expect_error(ErrorCode::io, {"none.brdfc"}, [&] { (void)load_scene(scene, options); });
}

}  // namespace
}  // namespace brdf::render::test
