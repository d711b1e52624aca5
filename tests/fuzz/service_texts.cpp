// SPDX-License-Identifier: Apache-2.0
// Any bytes as the texts that the daemon reads: names of materials, files of tokens and of settings, addresses. Refused with a sentence,
// or understood so that what is printed of them means the same. The first byte chooses the text.
#include "config/listen_address.h"
#include "config/load_settings.h"
#include "config/tokens.h"
#include "shared/content_hash.h"
#include "shared/excerpt.h"
#include "shared/material_name.h"

#include <brdf/error.h>

#include <cstdint>
#include <cstdlib>

namespace {

using namespace brdf;
using namespace brdf::service;

void require(bool holds) {
  if (!holds) std::abort();
}

void name(const std::string& text) {
  require(excerpt(text).size() <= 165 && utf8_prefix(text, 10).size() <= 10);
  const auto parsed = parse_material_name(text);
  if (!parsed) return;
  require(is_material_id(parsed->id) && parsed->id.find('/') == std::string::npos && parsed->id != "." && parsed->id != "..");
  require(parsed->version.empty() || is_version(parsed->version));
  require(text == (parsed->version.empty() ? material_name(parsed->id) : version_name(parsed->id, parsed->version)));
}

/// The last line is asked for as a token.
void tokens(const std::string& text) {
  const Tokens all = Tokens::parse(text, "tokens");
  const std::size_t at = text.rfind('\n');
  const auto role = all.role_of(at == std::string::npos ? text : text.substr(at + 1));
  require(!role || *role <= Role::admin);
}

void settings(const std::string& text) {
  Settings read;
  assign_toml(read, text, "brdfd.toml");
  (void)check_settings(read);
  Settings again;
  assign_toml(again, print_settings(read), "printed.toml");
  require(print_settings(again) == print_settings(read));
}

void address(const std::string& text) {
  const ListenAddress parsed = parse_listen_address(text);
  const ListenAddress again = parse_listen_address(parsed.text());
  require(again.path == parsed.path && again.host == parsed.host && again.port == parsed.port && again.stays_here() == parsed.stays_here());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  try {
    switch (data[0] % 4) {
      case 0: name(text); break;
      case 1: tokens(text); break;
      case 2: settings(text); break;
      case 3: address(text); break;
    }
  } catch (const Error& e) {
    require(e.what()[0] != '\0');
  }
  return 0;
}
