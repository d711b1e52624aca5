// SPDX-License-Identifier: Apache-2.0
// The form of every --json report: an object {schema, rows}.
#pragma once

#include "messages.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace brdf::cli {

using Json = nlohmann::ordered_json;

/// `verb` becomes the schema "PROGRAM/<verb>/1". Numbers that are not finite become null, text becomes UTF-8.
inline std::string json_report(std::string_view verb, Json rows) {
  Json document;
  document["schema"] = program_name() + "/" + std::string(verb) + "/1";
  document["rows"] = std::move(rows);
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace brdf::cli
