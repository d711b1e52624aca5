// SPDX-License-Identifier: Apache-2.0
// fetch and compress: files from and to the server.
#include "connection.h"
#include "input_bytes.h"
#include "options.h"
#include "output_file.h"
#include "progress_bar.h"
#include "standard_output.h"
#include "verbs.h"

#include <charconv>

namespace brdf::query {
namespace {

using cli::ExitCode;

struct FetchOptions {
  std::string name, output;
  client::FetchOptions until;
  bool force = false;
  cli::Reporting reporting;
};

ExitCode fetch(const Connection& connection, const FetchOptions& o) {
  cli::check_output(o.output, {}, o.force);
  const client::Fetched fetched = connection.open().fetch(resource_name(o.name), o.until);
  cli::write_output(o.output, fetched.bytes, o.force);
  o.reporting.say(fetched.version + ": " + std::to_string(fetched.bytes.size()) + " of " + std::to_string(fetched.file_bytes) + " bytes" + (fetched.from_cache ? ", from the cache" : ""));
  return ExitCode::ok;
}

struct CompressOptions {
  std::string input, name, target_error;
  int effort = 50;
  std::optional<std::uint64_t> target_size;
  bool force = false, centre = false;
  double seconds = 3600;
  cli::Reporting reporting;
};

v1::CompressOptions message_of(const CompressOptions& o) {
  v1::CompressOptions m;
  m.set_name(resource_name(o.name));
  m.set_effort(o.effort);
  m.set_overwrite(o.force);
  m.set_position_centre(o.centre);
  if (o.target_size) m.set_target_size(*o.target_size);
  if (o.target_error.empty()) return m;
  const std::size_t equals = o.target_error.find('=');
  double value = 0;
  const char* end = o.target_error.data() + o.target_error.size();
  if (equals == std::string::npos || std::from_chars(o.target_error.data() + equals + 1, end, value).ptr != end) {
    throw CLI::ValidationError("--target-error", "is '" + o.target_error + "', wanted is METRIC=E");
  }
  m.mutable_target_error()->set_metric(o.target_error.substr(0, equals));
  m.mutable_target_error()->set_value(value);
  return m;
}

ExitCode compress(const Connection& connection, const CompressOptions& o) {
  const v1::CompressOptions options = message_of(o);
  const auto bytes = input_bytes(o.input);
  v1::Material material;
  {
    cli::ProgressBar bar(o.reporting);
    const Progress show = bar.callback();
    material = connection.open().compress(
        options, bytes, [&show](const std::string& stage, double done) { return show(stage, done); }, std::chrono::milliseconds(static_cast<std::int64_t>(o.seconds * 1000)));
  }
  o.reporting.say(material.version() + ": " + std::to_string(material.bytes()) + " bytes");
  return ExitCode::ok;
}

}  // namespace

Verb add_fetch(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<FetchOptions>();
  CLI::App* verb = program.add_subcommand("fetch", "Write a material to a file, whole or as a prefix");
  verb->add_option("MATERIAL", o->name, "Name of a material")->required();
  verb->add_option("-o,--output", o->output, "File to write")->type_name("OUT.brdfc")->required();
  auto* bytes = verb->add_option("--max-bytes", o->until.max_bytes, "The longest prefix of at most this size")->check(cli::natural_number(1))->type_name("BYTES");
  verb->add_option("--max-error", o->until.max_log_mae, "The shortest prefix with at most this recorded log_mae")->type_name("E")->excludes(bytes);
  cli::add_force(*verb, o->force);
  cli::add_reporting(*verb, o->reporting, false);
  return {verb, [o, &connection] { return fetch(connection, *o); }};
}

Verb add_compress(CLI::App& program, const Connection& connection) {
  auto o = std::make_shared<CompressOptions>();
  CLI::App* verb = program.add_subcommand("compress", "Send a measured file; the server compresses and keeps it");
  verb->add_option("IN", o->input, "A measured file")->required();
  verb->add_option("MATERIAL", o->name, "Name that it gets")->required();
  verb->add_option("--effort", o->effort, "Encode time, 0 to 100")->check(CLI::Range(0, 100))->capture_default_str();
  auto* size = verb->add_option("--target-size", o->target_size, "Size of the whole file, never exceeded")->check(cli::natural_number(1))->type_name("BYTES");
  verb->add_option("--target-error", o->target_error, "Smallest file with at most this error")->type_name("METRIC=E")->excludes(size);
  verb->add_flag("--centre", o->centre, "Samples of a MERL table sit in the middle of their bins");
  verb->add_option("--time", o->seconds, "Deadline of the whole work")->type_name("SECONDS")->check(CLI::Range(1.0, 86400.0))->capture_default_str();
  cli::add_force(*verb, o->force);
  cli::add_reporting(*verb, o->reporting, false);
  return {verb, [o, &connection] { return compress(connection, *o); }};
}

}  // namespace brdf::query
