// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <brdf/client/client.h>

#include <grpcpp/create_channel.h>
#include <grpcpp/support/channel_arguments.h>

#include <signal.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>

namespace brdf::load {
namespace {

constexpr int callers = 4;
constexpr std::size_t pairs = 256;

struct Outcome {
  std::uint64_t answered = 0, failed = 0;
  double slowest = 0;
  std::string first_failure;
};

/// Calls from several threads until `end` is set. `call` throws where it fails.
Outcome keep_calling(const std::atomic<bool>& end, const std::function<void()>& call) {
  std::mutex mutex;
  Outcome sum;
  std::vector<std::thread> threads;
  for (int i = 0; i < callers; ++i) {
    threads.emplace_back([&] {
      Outcome mine;
      while (!end) {
        const auto start = Clock::now();
        try {
          call();
          ++mine.answered;
        } catch (const std::exception& e) {
          ++mine.failed;
          mine.first_failure = e.what();
        }
        mine.slowest = std::max(mine.slowest, seconds_since(start));
      }
      const std::lock_guard lock(mutex);
      sum.answered += mine.answered;
      sum.failed += mine.failed;
      sum.slowest = std::max(sum.slowest, mine.slowest);
      if (!mine.first_failure.empty()) sum.first_failure = mine.first_failure;
    });
  }
  for (std::thread& t : threads) t.join();
  return sum;
}

/// Two replicas that are ended and started again, one after the other. The thread of this object starts them: a process dies with
/// the thread that started it.
class Pair {
 public:
  explicit Pair(Setup& setup) : setup_(setup) {
    for (int i = 0; i < 2; ++i) served_.push_back(setup.serve({{"a", setup.default_material()}}));
    for (Served& s : served_) processes_.push_back(std::make_unique<Process>(std::move(s.process)));
  }
  std::vector<std::string> addresses() const { return {served_[0].address, served_[1].address}; }

  /// Ends one with a signal, waits for the end, and starts it again.
  void end_and_start(std::size_t which, int signal) {
    processes_[which]->signal(signal);
    clean_ends_ += static_cast<int>(processes_[which]->wait() == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    processes_[which] = std::make_unique<Process>(setup_.serve_again(served_[which].folder, {}));
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // the clients find it again
  }
  int clean_ends() const noexcept { return clean_ends_; }

 private:
  Setup& setup_;
  std::vector<Served> served_;
  std::vector<std::unique_ptr<Process>> processes_;
  int clean_ends_ = 0;
};

/// Ends replicas by turns while `call` goes on.
Outcome while_ending(Pair& replicas, int signal, int times, const std::function<void()>& call) {
  std::atomic<bool> end{false};
  Outcome outcome;
  std::thread calling([&] { outcome = keep_calling(end, call); });
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  for (int i = 0; i < times; ++i) replicas.end_and_start(static_cast<std::size_t>(i % 2), signal);
  end = true;
  calling.join();
  return outcome;
}

Row row_of(const std::string& name, const std::string& ran, const Outcome& o) {
  Row row;
  row.name = name;
  row.asked = "0 failed calls";
  row.reached = std::to_string(o.failed) + " failed of " + std::to_string(o.answered + o.failed) + ", the slowest took " + duration(o.slowest) + (o.failed != 0 ? " (" + o.first_failure + ")" : "");
  row.ran = ran;
  row.sound = row.met = o.failed == 0 && o.answered > 100;
  row.figures = {{"failed", static_cast<double>(o.failed)}, {"answered", static_cast<double>(o.answered)}, {"slowest_seconds", o.slowest}};
  return row;
}

}  // namespace

std::vector<Row> measure_replicas(Setup& setup) {
  Pair replicas(setup);
  const v1::EvaluateRequest request = evaluate_request("materials/a", pairs);
  const int kills = setup.is_long ? 12 : 2, drains = setup.is_long ? 4 : 1;
  const std::string with = std::to_string(callers) + " callers of " + std::to_string(pairs) + " pairs, ";

  client::ClientOptions options;
  options.servers = replicas.addresses();
  client::Client client(options);
  const auto evaluate = [&] { client.evaluate(request); };
  std::vector<Row> rows;
  rows.push_back(row_of("kill -9 of one of two replicas under load", with + "brdf::client; " + std::to_string(kills) + " kills, by turns, each started again", while_ending(replicas, SIGKILL, kills, evaluate)));
  rows.push_back(row_of("SIGTERM of one of two replicas: brdf::client", with + std::to_string(drains) + " ends, by turns", while_ending(replicas, SIGTERM, drains, evaluate)));

  grpc::ChannelArguments arguments;  // no retry: only health
  arguments.SetServiceConfigJSON(R"({"loadBalancingConfig": [{"round_robin": {}}], "healthCheckConfig": {"serviceName": "brdf.v1.BrdfService"}})");
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  const std::string target = "unix:" + options.servers[0].substr(5) + "," + options.servers[1].substr(5);
  const auto stub = v1::BrdfService::NewStub(grpc::CreateCustomChannel(target, grpc::InsecureChannelCredentials(), arguments));
  rows.push_back(row_of("SIGTERM of one of two replicas: a client that watches health and repeats nothing", with + "gRPC's round_robin; " + std::to_string(drains) + " ends, by turns",
                        while_ending(replicas, SIGTERM, drains, [&] {
                          Context context;
                          v1::EvaluateResponse response;
                          const grpc::Status status = stub->Evaluate(&context, request, &response);
                          if (!status.ok()) throw std::runtime_error(status.error_message());
                        })));
  for (Row& r : rows) {
    if (r.name.starts_with("SIGTERM") && replicas.clean_ends() != 2 * drains) r.sound = r.met = false;
  }
  return rows;
}

}  // namespace brdf::load
