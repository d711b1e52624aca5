// SPDX-License-Identifier: Apache-2.0
#include "material_checks.h"

#include <brdf/error.h>

#include "compressed_file.h"
#include "direction_planes.h"
#include "test_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::cli {
namespace {

std::string at_level(const Material& m) { return std::string("at ") + to_string(m.level()); }

std::string pair_text(const Vec3f& wi, const Vec3f& wo) {
  const auto text = [](const Vec3f& w) {
    return std::to_string(w.x) + "," + std::to_string(w.y) + "," + std::to_string(w.z);
  };
  return "wi " + text(wi) + " wo " + text(wo);
}

/// Counts pairs that break a rule and remembers the first.
class Offenders {
 public:
  void add(const Vec3f& wi, const Vec3f& wo) {
    if (count_++ == 0) first_ = pair_text(wi, wo);
  }
  Check check(const std::string& name, const Material& m) const {
    return {name, count_ == 0, static_cast<double>(count_), "0 pairs",
            at_level(m) + (count_ == 0 ? "" : ", " + first_)};
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

std::vector<float> planar_values(const Material& m, const DirectionPlanes& wi, const DirectionPlanes& wo) {
  std::vector<float> f(wi.size() * static_cast<std::size_t>(m.channels()));
  m.eval(wi.span(), wo.span(), {f.data(), wi.size()});
  return f;
}

}  // namespace

Check prefix_check(std::span<const std::byte> bytes, const std::string& path) {
  const std::vector<std::uint64_t> ends = refinement_ends(bytes, path);
  const auto present = std::count_if(ends.begin(), ends.end(), [&](std::uint64_t end) { return end <= bytes.size(); });
  Check check{"every prefix decodes", true, static_cast<double>(present), "all", ""};
  for (std::size_t k = 0; k < ends.size() && ends[k] <= bytes.size(); ++k) {
    try {
      const Material m = decode_file(bytes.first(static_cast<std::size_t>(ends[k])), EvalLevel::fast, true, path);
      for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact}) static_cast<void>(m.prepare(level));
      const bool counted = m.info().refinements_read == static_cast<int>(k) &&
                           m.info().refinements_total == static_cast<int>(ends.size()) - 1;
      if (!counted) throw Error(ErrorCode::malformed, "it reports another number of refinements");
    } catch (const Error& e) {
      check.ok = false;
      check.note = "cut at byte " + std::to_string(ends[k]) + ": " + e.what();
    }
  }
  return check;
}

Checks value_checks(const Material& material) {
  const TestPairs pairs = make_test_pairs();
  const std::size_t n = pairs.wi.size(), channels = static_cast<std::size_t>(material.channels());
  const std::vector<float> f = planar_values(material, pairs.wi, pairs.wo);
  const std::vector<float> exchanged = planar_values(material, pairs.wo, pairs.wi);
  Offenders not_finite, negative, below, not_reciprocal, differs;
  std::vector<float> scalar(channels);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f wi = pairs.wi.get(i), wo = pairs.wo.get(i);
    const bool above = wi.z > 0 && wo.z > 0;
    material.eval(wi, wo, scalar);
    for (std::size_t c = 0; c < channels; ++c) {
      const float v = f[c * n + i];
      if (!std::isfinite(v)) not_finite.add(wi, wo);
      if (v < 0) negative.add(wi, wo);
      if (!above && v != 0) below.add(wi, wo);
      if (v != exchanged[c * n + i]) not_reciprocal.add(wi, wo);
      // Other order of operations, fused multiply-adds and a different reciprocal, of single precision.
      const double gap = std::abs(static_cast<double>(v) - static_cast<double>(scalar[c]));
      if (!(gap <= 1e-3 * std::max(std::abs(static_cast<double>(v)), 1e-2))) differs.add(wi, wo);
    }
  }
  Checks checks{not_finite.check("values are finite", material), negative.check("values are not negative", material),
                below.check("zero below the horizon", material),
                differs.check("vector and scalar code agree", material)};
  if (material.info().reciprocal) checks.push_back(not_reciprocal.check("exactly reciprocal, as declared", material));
  return checks;
}

AlbedoAt largest_albedo(const Material& material) {
  constexpr int angles = 18;
  std::vector<float> a(static_cast<std::size_t>(material.channels()));
  AlbedoAt largest;
  for (int k = 0; k < angles; ++k) {
    const double theta = k * 5 * std::numbers::pi / 180;
    material.albedo(Vec3f(Vec3d(std::sin(theta), 0, std::cos(theta))), a);
    for (const float v : a) {
      largest.finite = largest.finite && std::isfinite(v);
      if (static_cast<double>(v) > largest.value) largest = {static_cast<double>(v), k * 5, largest.finite};
    }
  }
  return largest;
}

Check albedo_check(const Material& material) {
  constexpr double most = 1.5;
  const AlbedoAt largest = largest_albedo(material);
  Check check{"largest albedo", largest.finite && largest.value <= most, largest.value, "finite, at most 1.5",
              std::string(at_level(material)) + ", theta_o " + std::to_string(largest.theta_o) + " degrees"};
  if (check.value > 1) check.note += ", more than it receives";
  return check;
}

}  // namespace brdf::cli
