// SPDX-License-Identifier: Apache-2.0
// What renderers do, to be measured alone and beside others.
#pragma once

#include "server/load/setup.h"

#include <mutex>
#include <vector>

namespace brdf::load {

/// Two clients, batches of 256 pairs, a pause after each.
struct Honest {
  static constexpr const char* token = "0123456789abcdef-honest";
  static constexpr const char* bearer = "Bearer 0123456789abcdef-honest";
  /// A file for the daemon's flag --tokens that knows the token, for readers.
  static fs::path tokens_file(Setup& setup);

  std::vector<double> times;  ///< seconds of every call
  std::uint64_t failed = 0;
  std::string first_failure;

  void call(const Served& served, std::chrono::duration<double> time);

 private:
  void call(const Served& served, std::chrono::duration<double> time, unsigned seed, std::mutex& mutex);
};

}  // namespace brdf::load
