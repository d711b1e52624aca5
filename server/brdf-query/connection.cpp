// SPDX-License-Identifier: Apache-2.0
#include "connection.h"

#include "base/file_io.h"
#include "options.h"
#include "shared/material_name.h"

#include <cstdlib>

namespace brdf::query {
namespace {

std::string read_token(const std::string& file) {
  if (file.empty()) {
    const char* token = std::getenv("BRDF_TOKEN");
    return token == nullptr ? "" : token;
  }
  const auto bytes = base::read_file(file, 65536);
  std::string token(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  token.erase(token.find_last_not_of(" \t\r\n") + 1);
  return token;
}

/// The folder that the XDG base directory specification gives.
std::filesystem::path usual_cache() {
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg == '/') return std::filesystem::path(xdg) / "brdf";
  const char* home = std::getenv("HOME");
  return home == nullptr || *home == '\0' ? std::filesystem::path() : std::filesystem::path(home) / ".cache" / "brdf";
}

}  // namespace

client::Client Connection::open() const {
  client::ClientOptions o;
  o.servers = servers;
  o.deadline = deadline();
  o.by_material = by_material;
  o.token = read_token(token_file);
  o.ca_file = ca;
  o.certificate_file = certificate;
  o.key_file = key;
  if (!no_cache) o.cache = cache.empty() ? usual_cache() : std::filesystem::path(cache);
  return client::Client(std::move(o));
}

std::chrono::milliseconds Connection::deadline() const { return std::chrono::milliseconds(static_cast<std::int64_t>(deadline_seconds * 1000)); }

void add_connection(CLI::App& program, Connection& c) {
  program.add_option_function<std::string>("--server", [&c](const std::string& text) { c.servers = cli::split_list(text); }, "unix:PATH or HOST:PORT; replicas with commas")
      ->type_name("ADDR")
      ->required();
  program.add_option("--deadline", c.deadline_seconds, "Of every call")->type_name("SECONDS")->check(CLI::Range(0.001, 86400.0))->capture_default_str();
  program.add_flag("--by-material", c.by_material, "Each material at a replica of its own instead of round robin");
  program.add_option("--token-file", c.token_file, "File with the bearer token; else $BRDF_TOKEN")->type_name("FILE");
  auto* ca = program.add_option("--ca", c.ca, "PEM roots of the server's certificate: TLS")->type_name("FILE");
  auto* certificate = program.add_option("--certificate", c.certificate, "PEM certificate of this client")->type_name("FILE")->needs(ca);
  program.add_option("--key", c.key, "PEM key of --certificate")->type_name("FILE")->needs(certificate);
  program.add_option("--cache", c.cache, "Folder of fetched files (default: $XDG_CACHE_HOME/brdf)")->type_name("DIR");
  program.add_flag("--no-cache", c.no_cache, "Neither look for fetched files nor keep them");
}

std::string resource_name(const std::string& material) {
  return service::is_material_id(material) ? service::material_name(material) : material;
}

}  // namespace brdf::query
