// SPDX-License-Identifier: Apache-2.0
#include "server/load/honest_clients.h"
#include "server/load/hostile_clients.h"
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <thread>

namespace brdf::load {

std::vector<Row> measure_hostile(Setup& setup) {
  const fs::path tokens = Honest::tokens_file(setup);
  Served served = setup.serve({{"a", setup.default_material()}}, {"--tokens", tokens.string(), "--keepalive-seconds", "2"}, true);
  const std::size_t descriptors = served.process.descriptors();
  const int turns = setup.is_long ? 6 : 2;
  const std::chrono::duration<double> turn(setup.is_long ? 10 : 4);
  const std::uint64_t resets = (setup.is_long ? 50'000U : 5'000U) / static_cast<std::uint64_t>(turns);
  HostileCounts counts;
  const Hostile hostile{served, Honest::bearer, counts};
  Honest alone, beside;
  alone.call(served, turn / 4);
  alone.times.clear();
  std::uint64_t before = 0;
  for (int i = 0; i < turns; ++i) {
    alone.call(served, turn);
    if (i == 0) before = served.process.resident_bytes();
    std::atomic<bool> end{false};
    std::vector<std::thread> threads;
    const auto hostile_thread = [&](auto work) {
      threads.emplace_back([work] {
        use_idle_time();
        work();
      });
    };
    hostile_thread([&] { hostile.stay_silent(end, 1000); });
    hostile_thread([&] { hostile.stay_half_open(end, 100); });
    hostile_thread([&] { hostile.send_random_bytes(end); });
    hostile_thread([&] { hostile.reset_streams(end, resets, static_cast<double>(resets) / turn.count()); });
    hostile_thread([&] { hostile.make_bad_calls(end); });
    beside.call(served, turn);
    end = true;
    for (std::thread& t : threads) t.join();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  // Whoever went away without a word is found out by the handshake's and the keepalive's time.
  std::size_t left = 0;
  for (int i = 0; i < 100 && (left = served.process.descriptors()) > descriptors + 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const double ratio = quantile(beside.times, 0.99) / quantile(alone.times, 0.99);
  const std::uint64_t after = served.process.resident_bytes();
  Row row;
  row.name = "hostile clients";
  row.asked = "never down, honest clients' p99 at most 1.5 times";
  row.reached = std::to_string(alone.failed + beside.failed) + " failed of " + std::to_string(alone.times.size() + beside.times.size()) + " honest calls" + (beside.failed != 0 ? " (" + beside.first_failure + ")" : "") + "; p99 " +
                duration(quantile(beside.times, 0.99)) + " = " + number(ratio) + " times the " + duration(quantile(alone.times, 0.99)) + " alone; " + std::to_string(counts.not_refused) + " bad calls answered; " +
                number(static_cast<double>(after) / 1e6) + " MB after, " + number(static_cast<double>(before) / 1e6) + " before; " + std::to_string(left) + " descriptors after, " + std::to_string(descriptors) + " before";
  row.ran = std::to_string(turns) + " turns of " + number(turn.count()) + " s alone and beside: 1,000 silent connections at a time (" + std::to_string(counts.silent) + ", of which the daemon closed " + std::to_string(counts.closed) + "), " +
            std::to_string(counts.half_open) + " half-open HTTP/2, " + std::to_string(counts.random_bytes) + " of random bytes and lying frames, " + std::to_string(counts.resets) + " stream resets, " + std::to_string(counts.bad_calls) +
            " oversized, malformed, NaN, wrong token, path traversal; they have the time that daemon and honest clients leave";
  row.sound = alone.failed + beside.failed == 0 && counts.not_refused == 0 && served.process.runs() && left <= descriptors + 4;
  row.met = row.sound && ratio <= 1.5;
  row.figures = {{"p99_ratio", ratio}, {"p99_seconds", quantile(beside.times, 0.99)}, {"p99_alone_seconds", quantile(alone.times, 0.99)}, {"failed", static_cast<double>(alone.failed + beside.failed)}, {"resets", static_cast<double>(counts.resets)},
                 {"silent", static_cast<double>(counts.silent)}, {"closed", static_cast<double>(counts.closed)}, {"not_refused", static_cast<double>(counts.not_refused)}, {"bytes_before", static_cast<double>(before)}, {"bytes_after", static_cast<double>(after)},
                 {"descriptors_before", static_cast<double>(descriptors)}, {"descriptors_after", static_cast<double>(left)}};
  return {row};
}

}  // namespace brdf::load
