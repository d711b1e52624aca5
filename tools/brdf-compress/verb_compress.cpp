// SPDX-License-Identifier: Apache-2.0
#include "compress_report.h"
#include "input_file.h"
#include "output_file.h"
#include "profile_input.h"
#include "progress_bar.h"
#include "progress_lines.h"
#include "standard_output.h"
#include "verb_options.h"
#include "verbs.h"

#include <brdf/encode.h>

#include <charconv>
#include <cmath>
#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string input, output;
  EncodeOptions encode;
  std::string profile, profile_material;
  int threads = 0;
  int progress_descriptor = -1;
  SamplePosition position = SamplePosition::edge;
  bool force = false;
  Reporting reporting;
};

constexpr Metric metrics[] = {Metric::log_mae, Metric::cbrt_rms, Metric::psnr_env, Metric::psnr_lights,
                              Metric::albedo_error, Metric::profile};

/// "METRIC=E".
ErrorTarget parse_target(const std::string& text) {
  std::vector<std::string> names;
  for (const Metric m : metrics) names.emplace_back(to_string(m));
  const std::size_t equals = text.find('=');
  const std::optional<Metric> metric = metric_from_string(text.substr(0, equals));
  if (equals == std::string::npos || !metric) {
    throw CLI::ValidationError("--target-error", "is '" + text + "', wanted is METRIC=E with " + listed(names));
  }
  ErrorTarget target{*metric, 0};
  const char *begin = text.data() + equals + 1, *end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, target.value);
  if (error != std::errc{} || rest != end || !std::isfinite(target.value) || target.value < 0) {
    throw CLI::ValidationError("--target-error", "is '" + text + "', the value must be a number of at least 0");
  }
  return target;
}

void add_symmetry(CLI::App& verb, const std::string& name, SymmetryMode& mode, const std::string& purpose) {
  verb.add_option_function<std::string>(
          name,
          [&mode](const std::string& word) {
            mode = word == "keep"      ? SymmetryMode::keep
                   : word == "enforce" ? SymmetryMode::enforce
                                       : SymmetryMode::automatic;
          },
          purpose)
      ->check(CLI::IsMember({"auto", "keep", "enforce"}))
      ->type_name("auto|keep|enforce");
}

ExitCode run(const Options& o) {
  check_output(o.output, o.input, o.force);
  IngestOptions ingest;
  ingest.position = o.position;
  const std::vector<std::byte> bytes = read_input(o.input);
  const Measurement m = read_measurement(bytes, o.input, ingest);
  EncodeOptions options = o.encode;
  options.threads = thread_count(o.threads);
  if (!o.profile.empty()) {
    const Profile profile = read_profile(o.profile);
    const std::string slot = choose_slot(profile, o.profile, o.profile_material);
    options.profile = std::make_shared<const MaterialProfile>(profile.at(slot));
    options.profile_share = profile.share(slot);
  } else if (options.target_error && options.target_error->metric == Metric::profile) {
    throw CLI::ValidationError("--target-error", "of profile needs --profile");
  }
  EncodeResult result;
  {
    ProgressBar bar(o.reporting);
    result = compress(m, options, o.progress_descriptor < 0 ? bar.callback() : progress_lines(o.progress_descriptor));
  }
  write_output(o.output, result.bytes, o.force);
  const CompressReport report{o.input, o.output, m, options, result.summary};
  for (const std::string& line : summary_lines(report)) o.reporting.say(line);
  for (const std::string& line : detail_lines(report)) o.reporting.detail(line);
  if (o.reporting.json) print(json_report("compress", Json::array({json_row(report)})));
  return ExitCode::ok;
}

}  // namespace

Verb add_compress(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("compress", "Write a measured file as a .brdfc file");
  verb->add_option("IN", o->input, "A measured file, recognised by its content")->required();
  verb->add_option("-o,--output", o->output, "File to write")->type_name("OUT.brdfc")->required();
  add_force(*verb, o->force);

  o->encode.effort = preset_effort("medium");
  auto* preset = verb->add_option_function<std::string>(
                         "--preset", [o](const std::string& name) { o->encode.effort = preset_effort(name); },
                         "A named effort (default medium)")
                     ->check(CLI::IsMember(preset_names()))
                     ->type_name("NAME");
  verb->add_option("--effort", o->encode.effort, "Encode time, 0 to 100")
      ->check(CLI::Range(0, 100))
      ->type_name("0..100")
      ->excludes(preset);
  verb->add_flag_callback(
          "--efforts",
          [] {
            print(effort_table());
            throw CLI::Success();
          },
          "Print what each effort turns on, as Markdown, and exit")
      ->trigger_on_parse();
  auto* size = verb->add_option("--target-size", o->encode.target_size, "Size of the whole file, never exceeded")
                   ->check(natural_number(1))
                   ->type_name("BYTES");
  verb->add_option_function<std::string>(
          "--target-error", [o](const std::string& text) { o->encode.target_error = parse_target(text); },
          "Smallest file with at most this error (for psnr_*: at least these dB), at --eval")
      ->type_name("METRIC=E")
      ->excludes(size);
  add_eval_level(*verb, o->encode.level);
  add_symmetry(*verb, "--reciprocity", o->encode.reciprocity,
               "Exchange of the directions: as the data say, kept or made exact");
  add_symmetry(*verb, "--mirror", o->encode.mirror, "Mirror symmetry: as the data say, kept or made exact");
  verb->add_option_function<std::string>(
          "--energy", [o](const std::string& word) { o->encode.energy = word == "clamp" ? EnergyMode::clamp : EnergyMode::report; },
          "More light than arrives: say so, or scale the file down until no albedo exceeds max(1, the measurement's)")
      ->check(CLI::IsMember({"report", "clamp"}))
      ->type_name("report|clamp");
  add_position(*verb, o->position);
  verb->add_flag("--provenance", o->encode.store_provenance, "Store name, format, licence and hash of the source");
  verb->add_flag("--store-cdf", o->encode.store_cdf, "Store the sampling tables of --eval: some kilobytes, and decoding need not build them");
  auto* profile = verb->add_option("--profile", o->profile, "Spend the bytes where this scene looks: a profile, written by a renderer")->type_name("P");
  verb->add_option("--profile-material", o->profile_material, "Which slot of the profile the file is; not needed where there is one")
      ->type_name("SLOT")
      ->needs(profile);
  add_threads(*verb, o->threads);
  verb->add_option("--progress-descriptor", o->progress_descriptor, "Write lines 'SHARE STAGE' to this open file descriptor")
      ->type_name("N")
      ->check(CLI::Range(1, 1023));
  add_reporting(*verb, o->reporting);
  verb->footer(
      preset_help() +
      "\nMetrics of --target-error: log_mae, cbrt_rms, psnr_env, psnr_lights, albedo_error and, with --profile, profile.\n"
      "A target that cannot be met ends with exit code 4, says the best reachable value and writes nothing.\n\n"
      "Examples:\n"
      "  brdf-compress compress gold.binary -o gold.brdfc\n"
      "  brdf-compress compress gold.binary -o gold.brdfc --preset thorough --target-size 1024 -v\n"
      "  brdf-compress compress gold.binary -o gold.brdfc --target-error log_mae=0.002 --json\n"
      "  brdf-compress compress gold.binary -o gold.brdfc --profile scene.prof --profile-material lamp --target-error profile=0.05");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
