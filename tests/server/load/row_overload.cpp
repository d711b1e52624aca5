// SPDX-License-Identifier: Apache-2.0
#include "server/load/open_loop.h"
#include "server/load/rows.h"

#include <thread>

namespace brdf::load {
namespace {

// Large calls: load and daemon share the processors, and what sending and refusing takes of them is not there to drain the queue.
constexpr std::uint64_t queue_queries = 1'000'000, directions = 27, queries_of_a_direction = 9216;
constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;
constexpr std::uint64_t connection_memory = 64 * megabyte, table_budget = 64 * megabyte;

v1::AlbedoRequest albedo_request() {
  v1::AlbedoRequest r;
  r.set_material("materials/a");
  r.set_count(directions);
  r.set_wo(direction_planes(directions, 7));
  return r;
}

/// Time from a full queue to an empty one.
double drain_time(OpenLoop& load) {
  const auto start = Clock::now();
  for (std::uint64_t waits = 0; waits + directions * queries_of_a_direction <= queue_queries; waits += directions * queries_of_a_direction) load.send();
  load.wait_for_all();
  return seconds_since(start);
}

/// Answers a second when a few calls are always under way.
double capacity(OpenLoop& load, std::chrono::duration<double> time) {
  load.take();
  const auto start = Clock::now();
  while (seconds_since(start) < time.count()) {
    while (load.under_way() < 8) load.send();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  load.wait_for_all();
  return static_cast<double>(load.take().accepted.size()) / seconds_since(start);
}

std::vector<double> small_calls(v1::BrdfService::Stub& stub, int calls) {
  const v1::EvaluateRequest request = evaluate_request("materials/a", 16);
  std::vector<double> times;
  for (int i = 0; i < calls; ++i) {
    Context context;
    v1::EvaluateResponse response;
    const auto start = Clock::now();
    times.push_back(stub.Evaluate(&context, request, &response).ok() ? seconds_since(start) : 1e9);
  }
  return times;
}

/// Seconds until calls take no longer than before: the median of twenty.
double time_to_normal(v1::BrdfService::Stub& stub, double usual) {
  const auto start = Clock::now();
  while (median(small_calls(stub, 20)) > 1.5 * usual && seconds_since(start) < 10) {
  }
  return seconds_since(start);
}

}  // namespace

std::vector<Row> measure_overload(Setup& setup) {
  Served served = setup.serve({{"a", setup.default_material()}}, {"--queue-queries", std::to_string(queue_queries), "--max-batch-queries", std::to_string(directions * queries_of_a_direction), "--connection-memory-bytes", std::to_string(connection_memory),
                                                                  "--table-budget-bytes", std::to_string(table_budget)});
  OpenLoop load(served.address, albedo_request(), 16);
  const auto stub = v1::BrdfService::NewStub(new_channel(served.address));
  drain_time(load);
  std::vector<double> drains;
  for (int i = 0; i < 15; ++i) drains.push_back(drain_time(load));
  const double drain = median(drains), rate = capacity(load, std::chrono::seconds(setup.is_long ? 4 : 1));
  const double usual = median(small_calls(*stub, 500));
  const std::uint64_t before = served.process.resident_bytes();
  const double seconds = setup.is_long ? 30 : 5;
  load.take();
  load.send(10 * rate, std::chrono::duration<double>(seconds));
  const double normal = time_to_normal(*stub, usual);
  const OpenLoop::Counts c = load.take();
  const std::uint64_t peak = served.process.peak_resident_bytes(), cap = before + connection_memory + table_budget;
  std::uint64_t other = 0;
  for (const auto& [status, count] : c.others) other += count;
  const double accepted = quantile(c.accepted, 0.99), refused = quantile(c.refused, 0.99);
  Row row;
  row.name = "10 times overload for " + number(seconds) + " s";
  row.asked = "accepted p99 at most twice the time to drain a full queue, the rest refused within 20 ms, memory under its cap, normal within 1 s after";
  row.reached = "accepted p99 " + duration(accepted) + " = " + number(accepted / drain) + " times the " + duration(drain) + "; refused p99 " + duration(refused) + ", the slowest " + duration(quantile(c.refused, 1)) +
                "; peak " + number(static_cast<double>(peak) / 1e6) + " of " + number(static_cast<double>(cap) / 1e6) + " MB; normal after " + duration(normal);
  row.ran = number(10 * rate) + " Albedo calls/s of " + std::to_string(directions * queries_of_a_direction) + " queries each, 16 connections: " + std::to_string(c.accepted.size()) + " answered, " +
            std::to_string(c.refused.size()) + " refused with a time to come back, " + std::to_string(other) + " other, " + std::to_string(c.not_sent) + " that the load did not keep up to send";
  row.sound = other == 0 && c.without_pushback == 0 && !c.refused.empty() && !c.accepted.empty() && peak <= cap;
  row.met = row.sound && accepted <= 2 * drain && refused <= 0.02 && normal <= 1;
  row.figures = {{"accepted_p99_seconds", accepted}, {"drain_seconds", drain}, {"refused_p99_seconds", refused}, {"refused_max_seconds", quantile(c.refused, 1)}, {"accepted", static_cast<double>(c.accepted.size())},
                 {"refused", static_cast<double>(c.refused.size())}, {"not_sent", static_cast<double>(c.not_sent)}, {"peak_bytes", static_cast<double>(peak)}, {"cap_bytes", static_cast<double>(cap)}, {"normal_seconds", normal}};
  return {row};
}

}  // namespace brdf::load
