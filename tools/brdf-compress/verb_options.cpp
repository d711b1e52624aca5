// SPDX-License-Identifier: Apache-2.0
#include "verb_options.h"

#include <brdf/encode.h>

#include <algorithm>

namespace brdf::cli {

void add_position(CLI::App& verb, SamplePosition& position) {
  add_choice<SamplePosition>(verb, "--position", position,
                             {{"edge", SamplePosition::edge}, {"centre", SamplePosition::centre}},
                             "Where in its bin a sample of a MERL table sits (default edge)");
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const Preset& p : presets()) names.emplace_back(p.name);
  return names;
}

std::string preset_help() {
  std::string text = "Presets (points of --effort, which is encode time only):\n";
  for (const Preset& p : presets()) {
    std::string name(p.name);
    name.resize(12, ' ');
    std::string effort = std::to_string(p.effort);
    effort.insert(0, 3 - std::min<std::size_t>(3, effort.size()), ' ');
    text += "  " + name + effort + "  " + std::string(p.purpose) + "\n";
  }
  return text;
}

int preset_effort(const std::string& name) {
  for (const Preset& p : presets())
    if (p.name == name) return p.effort;
  throw CLI::ValidationError("--preset", "is '" + name + "', allowed is " + listed(preset_names()));
}

}  // namespace brdf::cli
