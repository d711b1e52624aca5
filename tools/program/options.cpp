// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <algorithm>
#include <charconv>
#include <thread>

namespace brdf::cli {

void add_reporting(CLI::App& verb, Reporting& reporting, bool json) {
  if (json) verb.add_flag("--json", reporting.json, "Write the report as JSON {schema, rows} to stdout");
  auto* quiet = verb.add_flag("-q,--quiet", reporting.quiet, "Only errors on stderr");
  verb.add_flag("-v,--verbose", reporting.verbose, "Say more on stderr")->excludes(quiet);
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

}  // namespace brdf::cli
