// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <stdexcept>

namespace brdf::load {
namespace {

std::vector<double> call_times(v1::BrdfService::Stub& stub, const v1::EvaluateRequest& request, int calls) {
  std::vector<double> times;
  for (int i = 0; i < calls; ++i) {
    Context context;
    v1::EvaluateResponse response;
    const auto start = Clock::now();
    if (!stub.Evaluate(&context, request, &response).ok()) throw std::runtime_error("a small call failed");
    times.push_back(seconds_since(start));
  }
  return times;
}

}  // namespace

std::vector<Row> measure_small_call(Setup& setup) {
  constexpr std::size_t pairs = 16;
  constexpr int calls = 250;
  Served served = setup.serve({{"a", setup.default_material()}});
  const std::string echo_address = "unix:" + (served.folder / "echo").string();
  const Process echo = setup.start_echo(echo_address);
  const auto ours = v1::BrdfService::NewStub(new_channel(served.address)), theirs = v1::BrdfService::NewStub(new_channel(echo_address));
  const v1::EvaluateRequest request = evaluate_request("materials/a", pairs);
  call_times(*ours, request, calls);
  call_times(*theirs, request, calls);
  const int turns = setup.is_long ? 60 : 12;
  std::vector<double> ratios, our_p50, echo_p50;
  for (int i = 0; i < turns; ++i) {
    echo_p50.push_back(median(call_times(*theirs, request, calls)));
    our_p50.push_back(median(call_times(*ours, request, calls)));
    ratios.push_back(our_p50.back() / echo_p50.back());
  }
  const double ratio = median(ratios);
  Row row;
  row.name = "one small call, one client: p50";
  row.asked = "at most 1.3 times the echo service's";
  row.reached = number(ratio) + " times (" + duration(median(our_p50)) + " and " + duration(median(echo_p50)) + ")";
  row.ran = std::to_string(pairs) + " pairs a call, unix socket, " + std::to_string(turns) + " turns of " + std::to_string(calls) + " calls, by turns with the echo service; medians";
  row.met = ratio <= 1.3;
  row.figures = {{"ratio", ratio}, {"p50_seconds", median(our_p50)}, {"echo_p50_seconds", median(echo_p50)}};
  return {row};
}

}  // namespace brdf::load
