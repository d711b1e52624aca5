// SPDX-License-Identifier: Apache-2.0
// Options that several programs share, so that they read the same everywhere.
#pragma once

#include "messages.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace brdf::cli {

void add_reporting(CLI::App& verb, Reporting& reporting, bool json = true);
void add_force(CLI::App& verb, bool& force);
/// --threads N; 0 stands for every processor and is resolved by thread_count.
void add_threads(CLI::App& verb, int& threads);
int thread_count(int wanted) noexcept;

/// Accepts decimal digits that fit 64 bits, at least `least`: CLI11 itself would wrap "-5" round.
CLI::Validator natural_number(std::uint64_t least = 0);
/// The parts of "a,b,c".
std::vector<std::string> split_list(const std::string& text);

/// "a, b or c", for sentences and help.
std::string listed(const std::vector<std::string>& words);

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

}  // namespace brdf::cli
