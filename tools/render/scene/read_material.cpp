// SPDX-License-Identifier: Apache-2.0
#include "scene/read_parts.h"

namespace brdf::render {
namespace {

constexpr Bounds unit{0, 1};

std::vector<float> channels(const Vec3f& rgb) { return {rgb.x, rgb.y, rgb.z}; }

MaterialFile read_file(const JsonPlace& p) {
  p.allow({"type", "file", "prefix", "eval", "position", "incident"});
  MaterialFile m;
  const JsonPlace file = p.at("file");
  if (file.is_array()) {
    for (const JsonPlace& one : file.elements()) m.files.push_back(one.text());
    if (m.files.empty()) file.fail("names no file");
  } else {
    m.files.push_back(file.text());
  }
  if (const auto prefix = p.find("prefix")) m.prefix = prefix->natural(1);
  if (const auto eval = p.find("eval")) {
    constexpr EvalLevel levels[] = {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact};
    m.level = levels[eval->choice({"fast", "balanced", "exact"})];
  }
  if (const auto position = p.find("position")) {
    m.position = position->choice({"edge", "centre"}) == 0 ? SamplePosition::edge : SamplePosition::centre;
  }
  if (const auto incident = p.find("incident")) {
    m.incident = incident->choice({"light", "viewer"}) == 0 ? IncidentSide::light : IncidentSide::viewer;
  }
  return m;
}

GgxReflector read_ggx(const JsonPlace& p) {
  p.allow({"type", "alpha", "alpha_x", "alpha_y", "f0", "multiple_scattering"});
  constexpr Bounds alphas{1e-4, 1};
  GgxReflector ggx;
  if (p.has("alpha") == (p.has("alpha_x") || p.has("alpha_y"))) p.fail("needs either 'alpha' or 'alpha_x' and 'alpha_y'");
  if (const auto alpha = p.find("alpha")) {
    ggx.alpha_x = ggx.alpha_y = alpha->number(alphas);
  } else {
    ggx.alpha_x = p.at("alpha_x").number(alphas);
    ggx.alpha_y = p.at("alpha_y").number(alphas);
  }
  ggx.f0 = channels(p.at("f0").colour(unit));
  ggx.multiple_scattering = p.boolean_or("multiple_scattering", false);
  if (ggx.multiple_scattering && ggx.alpha_x != ggx.alpha_y) p.at("multiple_scattering").fail("is for isotropic roughness only");
  return ggx;
}

}  // namespace

MaterialDescription read_material(const std::string& name, const JsonPlace& p) {
  MaterialDescription m{name, p.place(), {}};
  switch (p.at("type").choice({"file", "lambert", "ggx", "mirror", "dielectric"})) {
    case 0: m.what = read_file(p); break;
    case 1:
      p.allow({"type", "albedo"});
      m.what = AnalyticModel(Lambert{channels(p.at("albedo").colour(unit))});
      break;
    case 2: m.what = AnalyticModel(read_ggx(p)); break;
    case 3:
      p.allow({"type", "reflectance"});
      m.what = AnalyticModel(Mirror{channels(p.at("reflectance").colour(unit))});
      break;
    default:
      p.allow({"type", "ior"});
      m.what = AnalyticModel(Dielectric{p.at("ior").number({0.1, 10})});
  }
  return m;
}

}  // namespace brdf::render
