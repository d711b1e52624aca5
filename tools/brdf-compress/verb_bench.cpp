// SPDX-License-Identifier: Apache-2.0
#include "bench_measure.h"
#include "bench_plots.h"
#include "bench_report.h"
#include "networks.h"
#include "output_file.h"
#include "progress_bar.h"
#include "standard_output.h"
#include "verb_options.h"
#include "verbs.h"

#include <brdf/version.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

namespace brdf::cli {
namespace {

struct Options {
  std::vector<std::string> files, presets, against;
  std::vector<std::filesystem::path> networks;
  std::vector<std::uint64_t> sizes;
  std::vector<EvalLevel> levels{EvalLevel::balanced};
  std::string csv, markdown, plots, command_line;
  SamplePosition position = SamplePosition::edge;
  int threads = 1;
  bool force = false;
  Reporting reporting;

  bool is_against(const char* peer) const { return std::ranges::find(against, peer) != against.end(); }
};

std::vector<BenchSetting> settings(const Options& o) {
  std::vector<std::string> names = o.presets;
  // Sizes are compared at one effort unless more are asked for.
  if (names.empty()) names = o.sizes.empty() ? preset_names() : std::vector<std::string>{"medium"};
  std::vector<BenchSetting> list;
  for (const std::string& name : names) {
    if (o.sizes.empty()) list.push_back({name, preset_effort(name), std::nullopt});
    for (const std::uint64_t size : o.sizes) list.push_back({name, preset_effort(name), size});
  }
  return list;
}

/// Rows of all materials and settings; what fails is said and left out.
class Runner {
 public:
  explicit Runner(const Options& o) : o_(o), settings_(settings(o)), bar_(o.reporting) {
    if (o.is_against("neural")) networks_ = Networks::open(o.networks);
  }

  std::vector<BenchRow> run() {
    for (const std::string& file : o_.files) attempt([&] { material(file); });
    bar_.clear();
    return std::move(rows_);
  }
  /// The first failure, or ok.
  ExitCode first_failure() const noexcept { return first_failure_; }

 private:
  void material(const std::string& file) {
    const std::size_t first = jobs_done_;
    jobs_done_ += settings_.size();
    show(first, file);
    const MaterialSource source = MaterialSource::open(file, {EvalLevel::exact, {}, o_.position});
    if (source.is_compressed())
      throw Failure(ExitCode::bad_input, file + ": is compressed already, bench takes measured files");
    const BenchMaterial bench(source, thread_count(o_.threads));
    for (std::size_t k = 0; k < settings_.size(); ++k) {
      show(first + k, source.measurement().provenance.name + ", " + settings_[k].preset);
      attempt([&] {
        for (BenchRow& row : bench.measure(settings_[k], o_.levels)) rows_.push_back(std::move(row));
      });
    }
    if (networks_) attempt([&] { rows_.push_back(bench.measure(networks_->find(source.measurement()))); });
  }

  template <class Work>
  void attempt(Work work) {
    try {
      work();
    } catch (const Failure& e) {
      failed(e.code(), e.what());
    } catch (const Error& e) {
      failed(exit_code_of(e.code()), e.what());
    }
  }

  void failed(ExitCode code, const std::string& sentence) {
    bar_.clear();
    complain(sentence);
    if (first_failure_ == ExitCode::ok) first_failure_ = code;
  }

  void show(std::size_t job, const std::string& what) {
    bar_.show(what, static_cast<double>(job) / static_cast<double>(settings_.size() * o_.files.size()));
  }

  const Options& o_;
  std::vector<BenchSetting> settings_;
  std::optional<Networks> networks_;
  ProgressBar bar_;
  std::vector<BenchRow> rows_;
  std::size_t jobs_done_ = 0;
  ExitCode first_failure_ = ExitCode::ok;
};

std::string markdown_document(const Options& o, const TextTable& table) {
  return "<!-- made by: " + o.command_line + " -->\n\n`" + o.command_line + "`, version " + version() + ", " +
         simd_target() + "\n\n" + table.markdown();
}

void write_text(const std::string& path, const std::string& text, bool force) {
  write_output(path, std::as_bytes(std::span(text)), force);
}

/// Applies a check to every part of "a,b,c".
CLI::Validator each_of(const CLI::Validator& check) {
  const auto all = [check](const std::string& text) {
    for (std::string part : split_list(text)) {
      std::string complaint = check(part);
      if (!complaint.empty()) return complaint;
    }
    return std::string();
  };
  return {all, ""};
}

ExitCode run(const Options& o) {
  for (const std::string* file : {&o.csv, &o.markdown})
    if (!file->empty() && *file != "-") check_output(*file, {}, o.force);
  std::optional<BenchPlots> plots;
  if (!o.plots.empty()) plots.emplace(o.plots, o.force);
  Runner runner(o);
  const std::vector<BenchRow> rows = runner.run();
  if (rows.empty()) return runner.first_failure();
  const TextTable table = bench_table(rows, o.is_against("raw"));
  if (!o.csv.empty() && o.csv != "-") write_text(o.csv, bench_csv(rows), o.force);
  if (!o.markdown.empty()) write_text(o.markdown, markdown_document(o, table), o.force);
  if (plots) plots->write(json_report("bench", bench_json(rows)));
  if (o.reporting.json) {
    print(json_report("bench", bench_json(rows)));
  } else {
    print(o.csv == "-" ? bench_csv(rows) : table.terminal());
  }
  return runner.first_failure() == ExitCode::ok ? ExitCode::ok : ExitCode::batch_failed;
}

}  // namespace

Verb add_bench(CLI::App& program, const std::string& command_line) {
  auto o = std::make_shared<Options>();
  o->command_line = command_line;
  CLI::App* verb = program.add_subcommand("bench", "Size, speed and error of each preset, measured");
  verb->add_option("FILES", o->files, "Measured files")->required();
  verb->add_option_function<std::string>(
          "--presets", [o](const std::string& text) { o->presets = split_list(text); },
          "Presets to compare (default all; with --sizes medium)")
      ->check(each_of(CLI::IsMember(preset_names())))
      ->type_name("A,B,..");
  verb->add_option_function<std::string>(
          "--sizes",
          [o](const std::string& text) {
            o->sizes.clear();
            for (const std::string& part : split_list(text)) o->sizes.push_back(std::stoull(part));
          },
          "Target sizes to compare, in bytes")
      ->check(each_of(natural_number(1)))
      ->type_name("N,M,..");
  verb->add_option_function<std::string>(
          "--eval",
          [o](const std::string& word) {
            o->levels.clear();
            for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact})
              if (word == "all" || word == to_string(level)) o->levels.push_back(level);
          },
          "Evaluation level of every figure (default balanced)")
      ->check(CLI::IsMember({"fast", "balanced", "exact", "all"}))
      ->type_name("fast|balanced|exact|all");
  verb->add_option_function<std::string>(
          "--against", [o](const std::string& text) { o->against = split_list(text); },
          "Peers: 'raw' adds columns of how much faster than the measured table evaluation is, 'neural' a row of the\n"
          "material's published network")
      ->check(each_of(CLI::IsMember({"raw", "neural"})))
      ->type_name("raw,neural");
  verb->add_option("--networks", o->networks,
                   "Networks for --against neural; may be repeated (default data/models/nbrdf_*.npz of $BRDF_SHARED or\n"
                   "../shared)")
      ->type_name("FILE.npz")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--csv", o->csv, "Also write the rows as CSV; - writes them to stdout instead of the table")
      ->type_name("FILE|-");
  verb->add_option("--markdown", o->markdown, "Also write the table as Markdown, with the command line that made it")
      ->type_name("FILE");
  verb->add_option("--plots", o->plots,
                   "Also write plots (SVG, PNG) of error against bytes and against ns per evaluation; needs matplotlib")
      ->type_name("FOLDER");
  add_position(*verb, o->position);
  add_threads(*verb, o->threads);
  add_force(*verb, o->force);
  add_reporting(*verb, o->reporting);
  verb->footer(
      preset_help() +
      "\nns are per query, in batches of 4096 random pairs on one thread, lower quartile of repeats; 'sample' has pdf and\n"
      "weight; 'raw' is the measured table as float RGB, by a vectorised trilinear look-up. 'ratio' compares with the\n"
      "source file, 'native' with its numbers as float32. Errors are against the measured file, at the level of the row.\n"
      "--threads is for encoding and comparing.\n\n"
      "Examples:\n"
      "  brdf-compress bench gold.binary --against raw\n"
      "  brdf-compress bench *.binary --sizes 512,1024,2048 --eval all --csv sizes.csv\n"
      "  brdf-compress bench *.bsdf --presets fast,medium --markdown table.md -f\n"
      "  brdf-compress bench *.bsdf --sizes 512,1024,2700 --against raw,neural --plots plots");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli
