// SPDX-License-Identifier: Apache-2.0
#include "golden/make_golden.h"
#include "slices/slice_table.h"
#include "support/analytic_reference.h"
#include "support/direct_basis.h"
#include "support/direction_batch.h"

#include <brdf/lobes.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

namespace brdf::golden {
namespace {

/// Normal, mirror, retro, grazing, in and out of the plane of incidence.
std::vector<std::pair<Vec3f, Vec3f>> pairs() {
  const auto at = [](double degrees, double phi_degrees) {
    constexpr double degree = std::numbers::pi / 180;
    return test::direction_at(std::cos(degrees * degree), phi_degrees * degree);
  };
  return {{at(0, 0), at(0, 0)},     {at(30, 0), at(30, 180)},   {at(30, 0), at(33, 170)},  {at(45, 20), at(45, 20)},
          {at(60, 0), at(20, 90)},  {at(20, 90), at(60, 0)},    {at(70, 10), at(70, 190)}, {at(80, 0), at(75, 150)},
          {at(10, 300), at(55, 0)}, {at(50, 120), at(65, 250)}, {at(5, 0), at(12, 200)},   {at(84, 40), at(30, 80)}};
}

std::vector<std::byte> cut(std::span<const std::byte> bytes, int refinements) {
  const auto ends = container::boundaries(bytes, {});
  const auto part = bytes.first(ends.at(static_cast<std::size_t>(refinements)));
  return {part.begin(), part.end()};
}

using Evaluator = std::function<std::vector<double>(const Vec3f& wi, const Vec3f& wo)>;

/// The basis summed in double, or the table in slices, which decoding holds in float.
Evaluator direct(const std::vector<std::byte>& file) {
  const container::Content content = container::unpack(file, {}, true).content;
  if (content.analytic)
    return [model = *content.analytic](const Vec3f& wi, const Vec3f& wo) { return test::model_value(model, Vec3d(wi), Vec3d(wo)); };
  const auto coefficients =
      residual::dequantise(content.residual, content.component.transform, content.residual.layers.size());
  if (!coefficients.slices.empty())
    return [table = std::make_shared<slices::SliceTable>(coefficients)](const Vec3f& a, const Vec3f& b) {
      const Vec3d wi(a), wo(b);
      float f[3];
      table->eval(slices::slice_angles(wi.x, wi.y, wi.z, wo.x, wo.y, wo.z), wo.z, f);
      return std::vector<double>(f, f + 3);
    };
  return [lobes = content.lobes, coefficients, empty = content.residual.empty()](const Vec3f& wi, const Vec3f& wo) {
    std::vector<double> f(static_cast<std::size_t>(lobes.channels));
    eval_lobes(lobes, Vec3d(wi), Vec3d(wo), f);
    for (std::size_t c = 0; !empty && c < f.size(); ++c)
      f[c] = test::direct_value(coefficients, f[c], c, Vec3d(wi), Vec3d(wo));
    return f;
  };
}

Evaluator tabulated(const std::vector<std::byte>& file, const std::string& level) {
  DecodeOptions options;
  options.allow_prefix = true;
  options.level = level == "fast" ? EvalLevel::fast : level == "balanced" ? EvalLevel::balanced : EvalLevel::exact;
  return [material = Material::decode(file, options)](const Vec3f& wi, const Vec3f& wo) {
    std::vector<float> f(static_cast<std::size_t>(material.channels()));
    material.eval(wi, wo, f);
    return std::vector<double>(f.begin(), f.end());
  };
}

}  // namespace

void evaluate(std::span<const std::byte> bytes, std::vector<Expectation>& rows) {
  std::map<std::pair<std::string, int>, Evaluator> evaluators;
  for (Expectation& row : rows) {
    auto& f = evaluators[{row.level, row.refinements}];
    if (!f)
      f = row.level == "direct" ? direct(cut(bytes, row.refinements))
                                : tabulated(cut(bytes, row.refinements), row.level);
    row.f = f(row.wi, row.wo);
  }
}

std::vector<Expectation> expectations(std::span<const std::byte> bytes) {
  const int refinements = container::unpack(bytes, {}, false).refinements_total;
  std::vector<Expectation> rows;
  for (int r = 0; r <= refinements; ++r)
    for (const char* level : {"fast", "balanced", "exact", "direct"})
      for (const auto& [wi, wo] : pairs()) rows.push_back({level, r, wi, wo, {}});
  evaluate(bytes, rows);
  return rows;
}

std::string to_text(const std::vector<Expectation>& rows) {
  std::string text = "# level refinements wi.x wi.y wi.z wo.x wo.y wo.z f (one per channel, 1/sr)\n";
  char number[32];
  const auto put = [&](double v) {
    std::snprintf(number, sizeof number, " %.9g", v);
    text += number;
  };
  for (const Expectation& row : rows) {
    text += row.level + " " + std::to_string(row.refinements);
    for (const Vec3f& w : {row.wi, row.wo})
      for (const float v : {w.x, w.y, w.z}) put(static_cast<double>(v));
    for (const double v : row.f) put(v);
    text += "\n";
  }
  return text;
}

std::vector<Expectation> from_text(const std::string& text) {
  std::vector<Expectation> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream in(line);
    Expectation row;
    in >> row.level >> row.refinements;
    for (Vec3f* w : {&row.wi, &row.wo}) in >> w->x >> w->y >> w->z;
    for (double v; in >> v;) row.f.push_back(v);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace brdf::golden
