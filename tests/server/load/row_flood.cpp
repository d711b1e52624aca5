// SPDX-License-Identifier: Apache-2.0
#include "server/load/honest_clients.h"
#include "server/load/hostile_clients.h"
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <limits>
#include <thread>

namespace brdf::load {

std::vector<Row> measure_flood(Setup& setup) {
  constexpr std::uint64_t resets = 50'000, most_bytes = 500'000'000;  // a daemon that does not cut such connections takes 700 MB
  const fs::path tokens = Honest::tokens_file(setup);
  Served served = setup.serve({{"a", setup.default_material()}}, {"--tokens", tokens.string()}, true);
  HostileCounts counts;
  const Hostile hostile{served, Honest::bearer, counts};
  const std::chrono::duration<double> turn(2);
  Honest alone, beside;
  alone.call(served, turn / 4);
  alone.times.clear();
  alone.call(served, turn);
  const std::uint64_t before = served.process.resident_bytes();
  std::atomic<bool> end{false};
  const auto start = Clock::now();
  double took = 0;
  std::thread flood([&] {
    use_idle_time();
    hostile.reset_streams(end, resets, std::numeric_limits<double>::infinity());
    took = seconds_since(start);
    end = true;
  });
  while (!end) beside.call(served, turn / 8);
  flood.join();
  beside.call(served, turn / 2);
  const std::uint64_t peak = served.process.peak_resident_bytes();
  const double ratio = quantile(beside.times, 0.99) / quantile(alone.times, 0.99);
  Row row;
  row.name = "50,000 stream resets at once";
  row.asked = "never down, no honest call failed, memory bounded";
  row.reached = std::to_string(beside.failed) + " failed of " + std::to_string(beside.times.size()) + " honest calls" + (beside.failed != 0 ? " (" + beside.first_failure + ")" : "") + "; p99 " + duration(quantile(beside.times, 0.99)) + " = " +
                number(ratio) + " times the " + duration(quantile(alone.times, 0.99)) + " alone; at most " + number(static_cast<double>(peak) / 1e6) + " MB, " + number(static_cast<double>(before) / 1e6) + " before";
  row.ran = std::to_string(counts.resets) + " calls sent and reset in " + number(took) + " s, by one client that connects again as often as it is cut";
  row.sound = beside.failed == 0 && served.process.runs() && peak < most_bytes;
  row.met = row.sound;
  row.figures = {{"p99_ratio", ratio}, {"p99_seconds", quantile(beside.times, 0.99)}, {"p99_alone_seconds", quantile(alone.times, 0.99)}, {"failed", static_cast<double>(beside.failed)}, {"resets", static_cast<double>(counts.resets)}, {"peak_bytes", static_cast<double>(peak)}};
  return {row};
}

}  // namespace brdf::load
