// SPDX-License-Identifier: Apache-2.0
// list, info, similar and health: what the server has.
#include "connection.h"
#include "input_bytes.h"
#include "shared/material_name.h"
#include "options.h"
#include "standard_output.h"
#include "verbs.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace brdf::query {
namespace {

using cli::ExitCode;
using Json = nlohmann::ordered_json;

std::string lower(std::string name, std::string_view prefix) {
  if (name.starts_with(prefix)) name.erase(0, prefix.size());
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

std::string fitness(v1::Fitness f) { return f == v1::FITNESS_UNSPECIFIED ? "unknown" : lower(v1::Fitness_Name(f), "FITNESS_"); }
std::string level(v1::EvalLevel l) { return lower(v1::EvalLevel_Name(l), "EVAL_LEVEL_"); }

Json json_of(const v1::Material& m) {
  Json errors = Json::array(), refinements = Json::array();
  for (const v1::RecordedError& e : m.errors())
    errors.push_back({{"refinement", e.refinement()}, {"level", level(e.level())}, {"log_mae", e.log_mae()}, {"psnr_env_db", e.psnr_env()}, {"fit_for", fitness(e.fit_for())}});
  for (const v1::Refinement& r : m.refinements()) refinements.push_back({{"refinement", r.refinement()}, {"prefix_bytes", r.prefix_bytes()}});
  return {{"name", m.name()}, {"version", m.version()}, {"bytes", m.bytes()}, {"channels", m.channels().count()},
          {"channel_model", lower(v1::ChannelModel_Name(m.channels().model()), "CHANNEL_MODEL_")}, {"fit_for", fitness(m.fit_for())},
          {"reciprocal", m.reciprocal()}, {"mirror_symmetric", m.mirror_symmetric()}, {"refinements", refinements}, {"errors", errors},
          {"source", {{"name", m.provenance().name()}, {"format", m.provenance().format()}, {"licence", m.provenance().licence()}}}};
}

void print_json(const std::string& verb, const Json& rows) {
  cli::print(Json{{"schema", "brdf-query/" + verb + "/1"}, {"rows", rows}}.dump(2) + "\n");
}

std::string line_of(const v1::Material& m) {
  char text[256];
  const std::string id = service::parse_material_name(m.name()).value_or(service::MaterialName{m.name(), {}}).id;
  const std::string version = m.version().substr(m.version().rfind('/') + 1);
  std::snprintf(text, sizeof(text), "%-32s %8llu bytes  %3d channels  %-11s  %s\n", id.c_str(), static_cast<unsigned long long>(m.bytes()), m.channels().count(),
                fitness(m.fit_for()).c_str(), version.c_str());
  return text;
}

struct ListOptions {
  v1::ListMaterialsRequest request;
  std::string contains;
  std::uint64_t max_bytes = 0;
  bool json = false;
};

ExitCode list(const Connection& connection, const ListOptions& o) {
  client::Client client = connection.open();
  v1::ListMaterialsRequest request;
  request.set_page_size(1000);
  request.set_name_contains(o.contains);
  request.set_max_bytes(o.max_bytes);
  Json rows = Json::array();
  std::string text;
  do {
    const v1::ListMaterialsResponse page = client.list(request);
    for (const v1::Material& m : page.materials()) {
      if (o.json) rows.push_back(json_of(m));
      text += line_of(m);
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  o.json ? print_json("list", rows) : cli::print(text);
  return ExitCode::ok;
}

ExitCode info(const Connection& connection, const std::string& name, bool json) {
  const v1::Material m = connection.open().get(resource_name(name));
  if (json) {
    print_json("info", Json::array({json_of(m)}));
    return ExitCode::ok;
  }
  std::string text = m.version() + "\n" + line_of(m);
  for (const v1::RecordedError& e : m.errors()) {
    char line[160];
    std::snprintf(line, sizeof(line), "refinement %2d  %-8s  log_mae %.6g  psnr_env %.2f dB  fit for %s\n", e.refinement(), level(e.level()).c_str(), e.log_mae(), e.psnr_env(), fitness(e.fit_for()).c_str());
    text += line;
  }
  for (const v1::Refinement& r : m.refinements()) text += "refinement " + std::to_string(r.refinement()) + " ends at byte " + std::to_string(r.prefix_bytes()) + "\n";
  cli::print(text);
  return ExitCode::ok;
}

struct SimilarOptions {
  std::string like;
  int count = 10;
  bool file = false, json = false;
};

ExitCode similar(const Connection& connection, const SimilarOptions& o) {
  v1::FindSimilarRequest request;
  request.set_count(o.count);
  if (o.file) {
    const auto bytes = input_bytes(o.like);
    request.set_file(bytes.data(), bytes.size());
  } else {
    request.set_material(resource_name(o.like));
  }
  const v1::FindSimilarResponse found = connection.open().similar(request);
  Json rows = Json::array();
  std::string text;
  for (const v1::SimilarMaterial& m : found.materials()) {
    rows.push_back({{"version", m.version()}, {"distance", m.distance()}});
    char line[256];
    std::snprintf(line, sizeof(line), "%.5f  %s\n", m.distance(), m.version().c_str());
    text += line;
  }
  o.json ? print_json("similar", rows) : cli::print(text);
  return ExitCode::ok;
}

void add_json(CLI::App& verb, bool& json) { verb.add_flag("--json", json, "Write the report as JSON {schema, rows} to stdout"); }

}  // namespace

Verb add_list(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<ListOptions>();
  CLI::App* verb = program.add_subcommand("list", "Materials of the server");
  verb->add_option("--contains", o->contains, "Names that contain this")->type_name("TEXT");
  verb->add_option("--max-bytes", o->max_bytes, "Files of at most this size")->check(cli::natural_number(1))->type_name("BYTES");
  add_json(*verb, o->json);
  return {verb, [o, &connection] { return list(connection, *o); }};
}

Verb add_info(CLI::App& program, const Connection& connection) {
  struct Options {
    std::string name;
    bool json = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("info", "A material: version, errors per refinement, what it is fit for");
  verb->add_option("MATERIAL", o->name, "Name of a material")->required();
  add_json(*verb, o->json);
  return {verb, [o, &connection] { return info(connection, o->name, o->json); }};
}

Verb add_similar(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<SimilarOptions>();
  CLI::App* verb = program.add_subcommand("similar", "Materials that look alike, the nearest first");
  verb->add_option("MATERIAL", o->like, "Name of a material, or with --file a .brdfc file")->required();
  verb->add_flag("--file", o->file, "MATERIAL is a file here");
  verb->add_option("-n,--count", o->count, "At most so many")->check(CLI::Range(1, 100))->type_name("N")->capture_default_str();
  add_json(*verb, o->json);
  return {verb, [o, &connection] { return similar(connection, *o); }};
}

Verb add_health(CLI::App& program, const Connection& connection) {
  CLI::App* verb = program.add_subcommand("health", "Whether the server serves: exit code 0 and SERVING, else 1");
  return {verb, [&connection] {
            const bool serving = connection.open().healthy();
            cli::print(serving ? "SERVING\n" : "NOT_SERVING\n");
            return serving ? ExitCode::ok : ExitCode::failed;
          }};
}

}  // namespace brdf::query
