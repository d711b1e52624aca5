// SPDX-License-Identifier: Apache-2.0
#include "server/load/honest_clients.h"

#include "server/load/latency.h"

#include <fstream>
#include <thread>

namespace brdf::load {

fs::path Honest::tokens_file(Setup& setup) {
  fs::path file = setup.new_folder("tokens") / "tokens";
  std::ofstream(file) << "read " << token << "\n";
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  return file;
}

void Honest::call(const Served& served, std::chrono::duration<double> time) {
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < 2; ++i) threads.emplace_back([&, i] { call(served, time, i, mutex); });
  for (std::thread& t : threads) t.join();
}

void Honest::call(const Served& served, std::chrono::duration<double> time, unsigned seed, std::mutex& mutex) {
  const auto stub = v1::BrdfService::NewStub(new_channel(served.address));
  const v1::EvaluateRequest request = evaluate_request("materials/a", 256, seed);
  const auto start = Clock::now();
  while (seconds_since(start) < time.count()) {
    Context context;
    context.AddMetadata("authorization", bearer);
    v1::EvaluateResponse response;
    const auto sent = Clock::now();
    const grpc::Status status = stub->Evaluate(&context, request, &response);
    const double took = seconds_since(sent);
    {
      const std::lock_guard lock(mutex);
      times.push_back(took);
      if (!status.ok()) {
        ++failed;
        first_failure = status.error_message();
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace brdf::load
