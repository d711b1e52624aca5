// SPDX-License-Identifier: Apache-2.0
#include "config/load_settings.h"

#include <brdf/error.h>

#include "base/file_io.h"

#include <toml++/toml.h>

#include <sstream>

namespace brdf::service {
namespace {

std::string text_of(const toml::node& node, const std::string& origin) {
  if (const auto* s = node.as_string()) return s->get();
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  if (const auto* i = node.as_integer()) return std::to_string(i->get());
  if (const auto* d = node.as_floating_point()) {
    std::ostringstream text;
    text.precision(17);
    text << d->get();
    return text.str();
  }
  throw Error(ErrorCode::invalid_argument, origin + " is a table or date, wanted is a plain value");
}

void assign_node(Settings& settings, const Setting& setting, const toml::node& node, const std::string& origin) {
  const bool wants_text = std::holds_alternative<std::string Settings::*>(setting.field);
  if (const auto* list = std::get_if<TextList Settings::*>(&setting.field); list != nullptr && node.is_array()) {
    TextList values;
    for (const toml::node& part : *node.as_array()) {
      if (!part.is_string()) throw Error(ErrorCode::invalid_argument, origin + " must be a list of texts");
      values.push_back(part.as_string()->get());
    }
    settings.**list = values;
    return;
  }
  if (wants_text != node.is_string() && !(std::holds_alternative<TextList Settings::*>(setting.field) && node.is_string())) {
    throw Error(ErrorCode::invalid_argument, origin + (wants_text ? " must be a text" : " must not be a text"));
  }
  assign(settings, setting, text_of(node, origin), origin);
}

constexpr std::uint64_t largest_file = std::uint64_t{1} << 20;

}  // namespace

void assign_toml(Settings& settings, std::string_view text, const std::string& name) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& e) {
    throw Error(ErrorCode::invalid_argument, name + ":" + std::to_string(e.source().begin.line) + ": " + std::string(e.description()));
  }
  for (const auto& [key, node] : table) {
    const std::string origin = name + ":" + std::to_string(node.source().begin.line) + ": " + std::string(key.str());
    const Setting* setting = find_setting(key.str());
    if (setting == nullptr) throw Error(ErrorCode::invalid_argument, origin + " is no setting");
    assign_node(settings, *setting, node, origin);
  }
}

Settings load_settings(const std::filesystem::path& file, const Environment& environment, const Flags& flags) {
  Settings settings;
  if (!file.empty()) {
    const auto bytes = base::read_file(file, largest_file);
    assign_toml(settings, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
  }
  for (const Setting& setting : setting_table()) {
    const std::string variable = variable_of(setting);
    if (const auto text = environment(variable)) assign(settings, setting, *text, variable);
  }
  for (const auto& [name, text] : flags) {
    const Setting* setting = find_setting(name);
    if (setting == nullptr) throw Error(ErrorCode::invalid_argument, "'" + name + "' is no setting");
    assign(settings, *setting, text, flag_of(*setting));
  }
  return settings;
}

}  // namespace brdf::service
