// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace brdf::load {
namespace {

constexpr int callers = 4;

/// Pairs a second of callers that wait for one answer each, over their own connections.
class Turns {
 public:
  Turns(const std::string& address, const v1::EvaluateRequest& request) : request_(request) {
    const int limit = 16 << 20;
    for (int i = 0; i < callers; ++i) stubs_.push_back(v1::BrdfService::NewStub(new_channel(address, {{GRPC_ARG_MAX_RECEIVE_MESSAGE_LENGTH, limit}})));
  }

  double run(std::chrono::milliseconds time) {
    std::atomic<std::uint64_t> pairs{0};
    std::mutex mutex;
    std::string failed;
    std::vector<std::thread> threads;
    const auto start = Clock::now();
    for (const auto& stub : stubs_) {
      threads.emplace_back([&, this] {
        v1::EvaluateResponse response;
        while (Clock::now() - start < time) {
          Context context;
          const grpc::Status status = stub->Evaluate(&context, request_, &response);
          if (!status.ok() || response.values().size() != request_.wi().size()) {
            const std::lock_guard lock(mutex);
            failed = "a call of the throughput row failed: " + status.error_message();
          }
          pairs += request_.count();
        }
      });
    }
    for (std::thread& t : threads) t.join();
    if (!failed.empty()) throw std::runtime_error(failed);
    return static_cast<double>(pairs) / seconds_since(start);
  }

 private:
  const v1::EvaluateRequest request_;
  std::vector<std::unique_ptr<v1::BrdfService::Stub>> stubs_;
};

}  // namespace

std::vector<Row> measure_throughput(Setup& setup) {
  Served served = setup.serve({{"a", setup.default_material()}});
  const std::string echo_address = "unix:" + (served.folder / "echo").string();
  const Process echo = setup.start_echo(echo_address);
  const int turns = setup.is_long ? 12 : 3;
  const std::chrono::milliseconds time(setup.is_long ? 800 : 400);
  std::vector<Row> rows;
  for (const std::size_t count : {std::size_t{8192}, std::size_t{16384}}) {
    const v1::EvaluateRequest request = evaluate_request("materials/a", count);
    Turns ours(served.address, request), theirs(echo_address, request);
    ours.run(time / 4);
    theirs.run(time / 4);
    std::vector<double> shares, ours_speed, echo_speed;
    for (int i = 0; i < turns; ++i) {
      echo_speed.push_back(theirs.run(time));
      ours_speed.push_back(ours.run(time));
      shares.push_back(ours_speed.back() / echo_speed.back());
    }
    const double share = median(shares);
    Row row;
    row.name = "Evaluate, " + std::to_string(count) + " pairs a message";
    row.asked = "at least 70 % of the echo service's pairs/s";
    row.reached = number(100 * share) + " % (" + number(median(ours_speed) / 1e6) + " of " + number(median(echo_speed) / 1e6) + " million pairs/s)";
    row.ran = std::to_string(callers) + " callers, unix socket, " + std::to_string(turns) + " turns of " + number(std::chrono::duration<double>(time).count()) + " s each, by turns with the echo service; medians";
    row.met = share >= 0.7;
    row.figures = {{"share", share}, {"pairs_per_second", median(ours_speed)}, {"echo_pairs_per_second", median(echo_speed)}};
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace brdf::load
