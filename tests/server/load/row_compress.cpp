// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"

#include <brdf/client/client.h>

#include <signal.h>
#include <sys/resource.h>

#include <atomic>
#include <random>
#include <thread>

namespace brdf::load {
namespace {

using namespace std::chrono_literals;

v1::CompressOptions options_for(const std::string& name) {
  v1::CompressOptions o;
  o.set_name("materials/" + name);
  o.set_effort(0);
  o.set_target_size(600);
  return o;
}

client::ClientOptions client_of(const Served& served) {
  client::ClientOptions o;
  o.servers = {served.address};
  return o;
}

/// Of what is listed, what cannot be fetched whole and decoded; and of what lies in the folder, what is neither listed nor a
/// temporary file that no listing shows.
std::uint64_t partial_materials(const Served& served) {
  client::Client client(client_of(served));
  std::uint64_t bad = 0;
  const v1::ListMaterialsResponse listed = client.list({});
  for (const v1::Material& m : listed.materials()) {
    try {
      const client::Fetched fetched = client.fetch(m.name());
      bad += static_cast<std::uint64_t>(fetched.bytes.size() != m.bytes() || client.open(m.name()).channels() < 1);
    } catch (const std::exception&) {
      ++bad;
    }
  }
  std::uint64_t files = 0;
  for (const auto& entry : fs::directory_iterator(served.folder / "materials")) files += static_cast<std::uint64_t>(entry.path().extension() == ".brdfc");
  return bad + static_cast<std::uint64_t>(files != static_cast<std::uint64_t>(listed.materials_size()));
}

struct Kills {
  std::uint64_t finished = 0, partial = 0, tried = 0;
  double restart = 0;  ///< the slowest
};

/// Kills the daemon at some moment of each compression, starts it again, and looks at what it serves.
Kills kill_during_compressions(Setup& setup, Served& served, const std::vector<std::byte>& table, int times) {
  Kills kills;
  std::mt19937 random(11);
  double usual = 0.5;
  auto process = std::make_unique<Process>(std::move(served.process));
  for (int i = 0; i < times; ++i) {
    const std::string name = "m" + std::to_string(i % 4);  // some are new, some replace
    std::atomic<bool> done{false};
    const auto start = Clock::now();
    std::thread caller([&] {
      try {
        client::Client client(client_of(served));
        v1::CompressOptions o = options_for(name);
        o.set_overwrite(true);
        client.compress(o, table, {}, 60s);
        ++kills.finished;
      } catch (const std::exception&) {
      }
      done = true;
    });
    // The first tells how long it takes; the others are killed at any moment of it, most of them near the end, where files are written.
    const double moment = usual * (i % 2 == 0 ? std::uniform_real_distribution<>(0.85, 1.1)(random) : std::uniform_real_distribution<>(0.0, 1.0)(random));
    while (!done && (i == 0 || seconds_since(start) < moment)) std::this_thread::sleep_for(1ms);
    if (i == 0) usual = seconds_since(start);
    process->kill();
    caller.join();
    ++kills.tried;
    const auto again = Clock::now();
    process = std::make_unique<Process>(setup.serve_again(served.folder, {}));
    kills.restart = std::max(kills.restart, seconds_since(again));
    kills.partial += partial_materials(served);
  }
  return kills;
}

struct FullDisk {
  std::uint64_t refused = 0, partial = 0, published_after = 0;
  bool runs = false;
};

/// From the moment at which the work begins, the daemon may write no more than some bytes of any file, as on a disk that is full.
FullDisk fill_the_disk(Setup& setup, const std::vector<std::byte>& table) {
  Served served = setup.serve({{"a", setup.default_material()}});
  FullDisk full;
  client::Client client(client_of(served));
  const auto limit_files = [&](rlim_t bytes) {
    const rlimit limit{bytes, RLIM_INFINITY};
    ::prlimit(served.process.pid(), RLIMIT_FSIZE, &limit, nullptr);
  };
  for (const rlim_t bytes : {rlim_t{0}, rlim_t{100}, rlim_t{599}}) {
    try {
      client.compress(options_for("new"), table, [&](const std::string& stage, double) {
        if (stage != "waiting") limit_files(bytes);
        return true;
      }, 60s);
    } catch (const client::CallError&) {
      ++full.refused;
    }
    limit_files(RLIM_INFINITY);
    full.partial += partial_materials(served);
  }
  client.compress(options_for("new"), table, {}, 60s);
  full.published_after = static_cast<std::uint64_t>(client.list({}).materials_size() == 2);
  full.partial += partial_materials(served);
  full.runs = served.process.runs();
  return full;
}

}  // namespace

std::vector<Row> measure_compress(Setup& setup) {
  const std::vector<std::byte> table = read_bytes(setup.measured());
  Served served = setup.serve({{"a", setup.default_material()}});
  const Kills kills = kill_during_compressions(setup, served, table, setup.is_long ? 40 : 5);
  const FullDisk full = fill_the_disk(setup, table);
  Row row;
  row.name = "restart, full disk or kill -9 during Compress";
  row.asked = "no partial material is ever listed";
  row.reached = std::to_string(kills.partial + full.partial) + " partial materials; the slowest restart took " + duration(kills.restart);
  row.ran = std::to_string(kills.tried) + " kills at any moment of a compression (" + std::to_string(kills.finished) + " had finished), each followed by a restart; " + std::to_string(full.refused) + " of 3 refused while the disk was full, one published after";
  row.sound = row.met = kills.partial == 0 && full.partial == 0 && full.refused == 3 && full.published_after == 1 && full.runs;
  row.figures = {{"partial", static_cast<double>(kills.partial + full.partial)}, {"kills", static_cast<double>(kills.tried)}, {"restart_seconds", kills.restart}, {"refused", static_cast<double>(full.refused)}};
  return {row};
}

}  // namespace brdf::load
