// SPDX-License-Identifier: Apache-2.0
// Replicas, retries and the cache of the client.
#include "client/file_cache.h"
#include "client/replicas.h"
#include "server/batch.h"
#include "server/daemon_fixture.h"
#include "server/slow_relay.h"
#include "shared/content_hash.h"
#include "shared/error_table.h"
#include "shared/material_name.h"
#include "support/expect_error.h"

#include <map>
#include <set>

namespace {

using namespace brdf;
using namespace brdf::client;

TEST(Rendezvous, SharesEvenlyAndMovesOnlyWhatItMust) {
  const std::vector<std::string> servers{"10.0.0.1:1", "10.0.0.2:1", "10.0.0.3:1", "10.0.0.4:1"};
  const std::vector<std::string> fewer(servers.begin(), servers.end() - 1);
  std::map<std::size_t, int> share;
  int moved = 0;
  constexpr int materials = 4000;
  for (int i = 0; i < materials; ++i) {
    const std::string name = "material-" + std::to_string(i);
    const auto order = servers_for(servers, name);
    EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), servers.size());
    ++share[order[0]];
    const auto without = servers_for(fewer, name);
    if (order[0] == 3) {
      EXPECT_EQ(without[0], order[1]) << "what a server leaves goes to the next in its order";
    } else {
      moved += static_cast<int>(without[0] != order[0]);
    }
  }
  EXPECT_EQ(moved, 0);
  // Binomial: the standard deviation is 27.
  for (const auto& [server, count] : share) EXPECT_NEAR(count, materials / 4, 150) << server;
}

TEST(Target, OfOneOrSeveralServers) {
  EXPECT_EQ(target_of({"unix:/a"}), "unix:/a");
  EXPECT_EQ(target_of({"unix:/a", "unix:/b"}), "unix:/a,/b");
  EXPECT_EQ(target_of({"127.0.0.1:1", "127.0.0.1:2"}), "ipv4:127.0.0.1:1,127.0.0.1:2");
  EXPECT_EQ(target_of({"[::1]:1"}), "ipv6:[::1]:1");
  EXPECT_EQ(target_of({"example.org:443"}), "dns:example.org:443");
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{{}, {""}, {"host"}, {"unix:/a", "127.0.0.1:1"}, {"a.org:1", "b.org:1"}, {"unix:/a,/b"}})
    test::expect_error(ErrorCode::invalid_argument, {"server"}, [&] { target_of(bad); });
}

TEST(FileCache, BelievesContentsAndKeepsToItsSize) {
  test::TemporaryFolder folder;
  const FileCache cache(folder / "cache", 400);
  const auto &a = test::golden("rgb-reciprocal-layers"), &b = test::golden("rgb-slices");
  const std::string name_a = service::version_of(a), name_b = service::version_of(b);
  EXPECT_EQ(cache.find(name_a), std::nullopt);
  cache.store(name_a, a);
  EXPECT_EQ(cache.find(name_a), a);
  cache.store(name_b, a);  // a lie
  EXPECT_EQ(cache.find(name_b), std::nullopt);
  EXPECT_EQ(cache.find("../" + name_a), std::nullopt);
  cache.store(name_b, b);
  EXPECT_EQ(cache.find(name_b), b);
  EXPECT_EQ(cache.find(name_a), std::nullopt) << "272 and 227 bytes are more than 400: the older one goes";
  // What was stored last stays, however soon after the use of another.
  for (int i = 0; i < 50; ++i) {
    cache.store(name_a, a);
    ASSERT_EQ(cache.find(name_a), a) << i;
    cache.store(name_b, b);
    ASSERT_EQ(cache.find(name_b), b) << i;
  }
  FileCache("/proc/nowhere", 400).store(name_a, a);  // no error
}

TEST(Client, AsksAnotherReplicaWhenOneIsGone) {
  for (const bool by_material : {false, true}) {
    test::Served one, two;
    for (test::Served* s : {&one, &two}) {
      for (int i = 0; i < 8; ++i) s->put("m" + std::to_string(i), test::golden("rgb-lobes"));
      s->start();
    }
    ClientOptions options;
    options.servers = {one.settings.listen[0], two.settings.listen[0]};
    options.by_material = by_material;
    Client client(options);
    const auto ask_all = [&] {
      for (int i = 0; i < 8; ++i) EXPECT_EQ(client.get("materials/m" + std::to_string(i)).name(), "materials/m" + std::to_string(i));
    };
    ask_all();
    one.daemon.reset();
    ask_all();
    EXPECT_EQ(client.fetch("materials/m0").bytes, test::golden("rgb-lobes"));
    two.daemon.reset();
    EXPECT_THROW(client.get("materials/m0"), CallError);
  }
}

TEST(Client, StreamsGoOnAtAnotherReplica) {
  test::Served one, two;
  for (test::Served* s : {&one, &two}) {
    s->put("a", test::golden("rgb-slices"));
    s->start();
  }
  ClientOptions options;
  options.servers = {one.settings.listen[0], two.settings.listen[0]};
  Client client(options);
  const test::Batch batch(300);
  const std::string expected = client.evaluate(batch.request).values();
  std::uint64_t asked = 0, answered = 0;
  client.evaluate_stream(
      [&](v1::EvaluateRequest& r) {
        r = batch.request;
        return asked++ < 150;
      },
      [&](std::uint64_t id, const v1::EvaluateResponse& r) {
        EXPECT_EQ(id, answered++);
        EXPECT_EQ(r.values(), expected);
        if (answered == 20) one.daemon.reset();
        if (answered == 60) one.start();
        if (answered == 100) two.daemon.reset();
      },
      std::chrono::minutes(2));
  EXPECT_EQ(answered, 150U);
  one.daemon.reset();
  EXPECT_THROW(client.evaluate_stream([&](v1::EvaluateRequest& r) { return r = batch.request, true; }, [](std::uint64_t, const v1::EvaluateResponse&) { FAIL(); }, std::chrono::seconds(30)), CallError);
}

TEST(Client, FetchesPrefixesAndOpensThem) {
  test::Served s;
  const auto& bytes = test::golden("rgb-reciprocal-layers");
  s.put("a", bytes);
  s.start();
  ClientOptions options = s.client_options();
  options.cache = s.folder / "cache";
  Client client(options);
  const std::uint64_t cut = refinement_boundaries(bytes).front();
  const Fetched fetched = client.fetch("materials/a", {cut, std::nullopt});
  EXPECT_EQ(fetched.bytes.size(), cut);
  EXPECT_EQ(fetched.file_bytes, bytes.size());
  EXPECT_FALSE(fetched.from_cache);
  EXPECT_TRUE(client.fetch("materials/a", {cut, std::nullopt}).from_cache);
  EXPECT_EQ(client.open("materials/a", {}, {cut, std::nullopt}).info().refinements_read, 0);
  const Fetched whole = client.fetch("materials/a");
  EXPECT_FALSE(whole.from_cache);
  EXPECT_EQ(whole.bytes, bytes);
  s.daemon.reset();
  EXPECT_TRUE(client.fetch(whole.version).from_cache) << "a version that is here whole needs no server";
  EXPECT_THROW(client.fetch("materials/a"), CallError);
}

TEST(Client, WaitsForHandshakesOfFarServers) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  s.start();
  const test::SlowRelay relay((s.folder / "socket").string(), std::chrono::seconds(1));
  ClientOptions options;
  options.servers = {relay.address()};
  options.deadline = std::chrono::minutes(1);
  EXPECT_EQ(Client(options).get("materials/a").name(), "materials/a");
}

TEST(Client, EveryCallHasADeadline) {
  ClientOptions options;
  options.servers = {"unix:/nowhere/at/all"};
  options.deadline = std::chrono::milliseconds(300);
  Client client(options);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW(client.get("materials/a"), CallError);
  EXPECT_THROW(client.healthy(), CallError);
  EXPECT_LT(std::chrono::steady_clock::now() - start, options.deadline * 40);
}

TEST(ErrorTable, HasEveryCodeOnce) {
  std::set<ErrorCode> codes;
  for (const service::ErrorRow& row : service::error_table()) {
    EXPECT_TRUE(codes.insert(row.code).second) << to_string(row.code);
    EXPECT_NE(row.status, grpc::StatusCode::OK);
    EXPECT_EQ(service::status_of(row.code), row.status);
  }
  for (int c = 0; c <= static_cast<int>(ErrorCode::cancelled); ++c) EXPECT_TRUE(codes.contains(static_cast<ErrorCode>(c))) << c;
}

}  // namespace
