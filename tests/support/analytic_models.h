// SPDX-License-Identifier: Apache-2.0
// Analytic models of every kind, with names that tests can carry.
#pragma once

#include <brdf/analytic.h>

#include <ostream>
#include <string>
#include <vector>

namespace brdf::test {

struct NamedModel {
  std::string name;
  AnalyticModel model;
};

inline void PrintTo(const NamedModel& m, std::ostream* out) { *out << m.name; }

/// Those that have a density.
inline std::vector<NamedModel> spread_models() {
  return {{"lambert", Lambert{{0.8f, 0.4f, 0.2f}}},
          {"glossy", GgxReflector{0.1f, 0.1f, {0.04f, 0.04f, 0.04f}}},
          {"rough", GgxReflector{1, 1, {0.9f, 0.7f, 0.4f}}},
          {"narrow", GgxReflector{0.01f, 0.01f, {1, 1, 1}}},
          {"brushed", GgxReflector{0.1f, 0.4f, {0.9f, 0.8f, 0.7f}}},
          {"scratched", GgxReflector{1, 0.05f, {0.5f}}},
          {"compensated", GgxReflector{0.6f, 0.6f, {1, 0.7f, 0.04f}, true}},
          {"white", GgxReflector{1, 1, {1}, true}},
          {"five channels", GgxReflector{0.3f, 0.2f, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f}}}};
}

/// Those of delta lobes.
inline std::vector<NamedModel> delta_models() {
  return {{"mirror", Mirror{{0.9f, 0.8f, 0}}},
          {"glass", Dielectric{1.5f, 3}},
          {"bubble", Dielectric{0.75f, 1}},
          {"nothing", Dielectric{1, 3}},
          {"diamond", Dielectric{4, 3}}};
}

inline std::vector<NamedModel> all_models() {
  std::vector<NamedModel> all = spread_models();
  for (const NamedModel& m : delta_models()) all.push_back(m);
  return all;
}

}  // namespace brdf::test
