// SPDX-License-Identifier: Apache-2.0
#include "verb_options.h"

#include <brdf/encode.h>

#include <algorithm>
#include <charconv>
#include <thread>
#include <utility>

namespace brdf::cli {
namespace {

/// An option that takes one of a few words.
template <class T>
CLI::Option* add_choice(CLI::App& verb, const std::string& name, T& value,
                        const std::vector<std::pair<std::string, T>>& choices, const std::string& purpose) {
  std::vector<std::string> words;
  for (const auto& [word, meaning] : choices) words.push_back(word);
  return verb
      .add_option_function<std::string>(
          name,
          [&value, choices, words, name](const std::string& word) {
            const auto found =
                std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == word; });
            if (found == choices.end()) {
              throw CLI::ValidationError(name, "is '" + word + "', allowed is " + listed(words));
            }
            value = found->second;
          },
          purpose)
      ->type_name(listed(words));
}

}  // namespace

void add_reporting(CLI::App& verb, Reporting& reporting, bool json) {
  if (json) verb.add_flag("--json", reporting.json, "Write the report as JSON {schema, rows} to stdout");
  auto* quiet = verb.add_flag("-q,--quiet", reporting.quiet, "Only errors on stderr");
  verb.add_flag("-v,--verbose", reporting.verbose, "Say more on stderr")->excludes(quiet);
}

void add_eval_level(CLI::App& verb, EvalLevel& level) {
  add_choice<EvalLevel>(
      verb, "--eval", level,
      {{"fast", EvalLevel::fast}, {"balanced", EvalLevel::balanced}, {"exact", EvalLevel::exact}},
      "Evaluation cost of a .brdfc file: lobes only, a small table, the full table (default balanced)");
}

void add_prefix(CLI::App& verb, std::optional<std::uint64_t>& prefix) {
  verb.add_option("--prefix", prefix, "Read only the first BYTES of a .brdfc file; 'info' lists where it may be cut")
      ->check(natural_number(1))
      ->type_name("BYTES");
}

void add_position(CLI::App& verb, SamplePosition& position) {
  add_choice<SamplePosition>(verb, "--position", position,
                             {{"edge", SamplePosition::edge}, {"centre", SamplePosition::centre}},
                             "Where in its bin a sample of a MERL table sits (default edge)");
}

void add_row_format(CLI::App& verb, RowFormat& format) {
  add_choice<RowFormat>(verb, "--format", format, {{"csv", RowFormat::csv}, {"f32", RowFormat::f32}},
                        "Rows as text, or as raw little-endian float32 (default csv)");
}

void add_force(CLI::App& verb, bool& force) { verb.add_flag("-f,--force", force, "Replace an existing file"); }

void add_threads(CLI::App& verb, int& threads) {
  verb.add_option("--threads", threads, "Threads; 0 = one per processor. The output does not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

int thread_count(int wanted) noexcept {
  if (wanted > 0) return wanted;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

CLI::Validator natural_number(std::uint64_t least) {
  const auto check = [least](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc{} && rest == text.data() + text.size() && value >= least) return {};
    return "is '" + text + "', allowed is a whole number of at least " + std::to_string(least);
  };
  return {check, ""};
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
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
