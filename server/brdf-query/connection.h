// SPDX-License-Identifier: Apache-2.0
// Where the server is and who asks: options of every verb.
#pragma once

#include <brdf/client/client.h>

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace brdf::query {

struct Connection {
  std::vector<std::string> servers;
  double deadline_seconds = 10;
  bool by_material = false, no_cache = false;
  std::string token_file, cache;
  std::string ca, certificate, key;

  /// Throws Error. The token comes from the file or from $BRDF_TOKEN, never from the command line, which others can read.
  client::Client open() const;
  std::chrono::milliseconds deadline() const;
};

void add_connection(CLI::App& program, Connection& connection);

/// "gold" and "materials/gold" are the same; "materials/gold/versions/..." is one content.
std::string resource_name(const std::string& material);

}  // namespace brdf::query
