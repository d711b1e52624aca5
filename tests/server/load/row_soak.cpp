// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <brdf/client/client.h>

#include <signal.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace brdf::load {
namespace {

using namespace std::chrono_literals;

/// What clients do, each over and over: true where a call ended as it should.
using Habit = std::function<bool(client::Client& client, std::size_t round)>;

bool refused(const std::function<void()>& call, grpc::StatusCode code) {
  try {
    call();
  } catch (const client::CallError& e) {
    return e.code() == code;
  }
  return false;
}

std::vector<Habit> habits() {
  return {
      [](client::Client& c, std::size_t i) {
        const std::size_t count = std::size_t{1} << (i % 14);
        return c.evaluate(evaluate_request(i % 2 == 0 ? "materials/a" : "materials/b", count)).count() == count;
      },
      [](client::Client& c, std::size_t) {
        int asked = 0, answered = 0;
        c.evaluate_stream([&](v1::EvaluateRequest& r) { r = evaluate_request("materials/a", 2000); return asked++ < 6; },
                          [&](std::uint64_t, const v1::EvaluateResponse&) { ++answered; }, 20s);
        return answered == 6;
      },
      [](client::Client& c, std::size_t i) {
        if (i % 4 == 0) return c.list({}).materials_size() >= 2;
        if (i % 4 == 1) return c.get("materials/a").name() == "materials/a";
        return c.fetch("materials/b").bytes.size() > 100;
      },
      [](client::Client& c, std::size_t) {
        v1::AlbedoRequest r;
        r.set_material("materials/a");
        r.set_count(1);
        r.set_wo(direction_planes(1, 3));
        v1::FindSimilarRequest like;
        like.set_material("materials/a");
        return c.albedo(r).count() == 1 && c.similar(like).materials_size() >= 1;
      },
      [](client::Client& c, std::size_t) {
        v1::EvaluateRequest bad = evaluate_request("materials/a", 10);
        bad.mutable_wi()->resize(7);
        return refused([&] { c.evaluate(bad); }, grpc::StatusCode::INVALID_ARGUMENT) && refused([&] { c.get("materials/none"); }, grpc::StatusCode::NOT_FOUND);
      },
  };
}

/// Clients that hang up in the middle, watchers that come and go, connections that are new each time.
bool come_and_go(const Served& served, std::size_t i) {
  const auto stub = v1::BrdfService::NewStub(new_channel(served.address));
  if (i % 2 == 0) {
    Context context(20s);
    const auto watch = stub->WatchMaterials(&context, {});
    v1::WatchMaterialsResponse first;
    const bool heard = watch->Read(&first);
    context.TryCancel();
    watch->Finish();
    return heard;
  }
  Context context(i % 4 == 1 ? 1ms : 5000ms);
  v1::EvaluateResponse response;
  stub->Evaluate(&context, evaluate_request("materials/a", 50'000), &response);
  return true;
}

struct Sample {
  double seconds, bytes;
};

/// Theil and Sen: the median of the slopes of all pairs, which a single step does not move.
double slope(const std::vector<Sample>& samples) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t j = i + 1; j < samples.size(); ++j) slopes.push_back((samples[j].bytes - samples[i].bytes) / (samples[j].seconds - samples[i].seconds));
  return median(slopes);
}

}  // namespace

std::vector<Row> measure_soak(Setup& setup) {
  Served served = setup.serve({{"a", setup.default_material()}, {"b", setup.compressed_to(600)}}, {"--poll-interval-seconds", "1"});
  const std::vector<std::byte> other = setup.compressed_to(500), first = setup.compressed_to(600);
  const double seconds = setup.soak_seconds > 0 ? setup.soak_seconds : setup.is_long ? 600 : 120, warm = seconds / 4;
  const std::size_t descriptors = served.process.descriptors();
  const std::string kinds = served.process.descriptor_kinds();
  std::atomic<bool> end{false};
  std::atomic<std::uint64_t> calls{0}, wrong{0};
  std::mutex mutex;
  std::string first_wrong;
  const auto count_wrong = [&](std::size_t number, const std::string& reason) {
    const std::lock_guard lock(mutex);
    if (wrong++ == 0) first_wrong = "habit " + std::to_string(number) + ": " + reason;
  };
  std::vector<std::thread> threads;
  const auto keep = [&](const std::function<bool(std::size_t)>& habit, std::chrono::milliseconds pause) {
    threads.emplace_back([&, habit, pause, number = threads.size()] {
      for (std::size_t i = 0; !end; ++i) {
        try {
          if (!habit(i)) count_wrong(number, "not the answer that it should be");
        } catch (const std::exception& e) {
          count_wrong(number, e.what());
        }
        ++calls;
        std::this_thread::sleep_for(pause);
      }
    });
  };
  client::ClientOptions options;
  options.servers = {served.address};
  client::Client client(options);
  for (const Habit& habit : habits()) keep([&client, habit](std::size_t i) { return habit(client, i); }, 10ms);
  keep([&](std::size_t i) { return come_and_go(served, i); }, 20ms);
  keep([&](std::size_t i) { return put_file(served.file_of("b"), i % 2 == 0 ? other : first), true; }, 3000ms);

  std::vector<Sample> samples;
  const auto start = Clock::now();
  for (double at = 0; (at = seconds_since(start)) < seconds;) {
    if (at > warm) samples.push_back({at, static_cast<double>(served.process.resident_bytes())});
    std::this_thread::sleep_for(500ms);
  }
  end = true;
  for (std::thread& t : threads) t.join();
  threads.clear();
  client = client::Client(options);
  std::size_t left = 0;
  // What a busy machine cut off halfway is found out by the time of handshakes or of the keepalive, 2 and 40 s.
  for (int i = 0; i < 600 && (left = served.process.descriptors()) > descriptors; ++i) std::this_thread::sleep_for(100ms);
  const std::string kinds_left = served.process.descriptor_kinds();
  served.process.signal(SIGTERM);
  const int code = served.process.wait();  // sanitizers end with another code where they had something to report
  const double per_minute = 60 * slope(samples);
  Row row;
  row.name = "soak, " + number(seconds / 60) + (seconds > 60 ? " minutes" : " minute");
  row.asked = "memory slope under 1 MB/min, descriptors constant";
  row.reached = number(per_minute / 1e6) + " MB/min, " + number(samples.back().bytes / 1e6) + " MB at the end; " + std::to_string(left) + " descriptors after, " + std::to_string(descriptors) + " before" + (left > descriptors ? " (" + kinds_left + "; " + kinds + ")" : "") + "; " + std::to_string(wrong) + " of " +
                std::to_string(calls) + " calls ended otherwise than they should" + (wrong == 0 ? "" : " (" + first_wrong + ")");
  row.ran = "batches of 1 to 8192 pairs, streams, fetches, lists, albedos, likeness, refused calls, watchers and clients that hang up, a new version every 3 s; slope of Theil and Sen after the first quarter";
  if (setup.is_sanitized) row.ran += "; built with sanitizers, which keep memory that was freed: its growth is not judged";
  if (code != 0) row.reached += "; the daemon ended with " + std::to_string(code);
  row.met = wrong == 0 && (setup.is_sanitized || per_minute < 1e6) && left <= descriptors && code == 0;
  // Two minutes leave room for the steps in which an allocator grows; ten do not.
  row.sound = wrong == 0 && (setup.is_sanitized || per_minute < (setup.is_long ? 1e6 : 4e6)) && left <= descriptors && code == 0;
  row.figures = {{"bytes_per_minute", per_minute}, {"bytes", samples.back().bytes}, {"descriptors_before", static_cast<double>(descriptors)}, {"descriptors_after", static_cast<double>(left)}, {"calls", static_cast<double>(calls)}, {"wrong", static_cast<double>(wrong)}};
  return {row};
}

}  // namespace brdf::load
