// SPDX-License-Identifier: Apache-2.0
// Admission, deadlines and cancellation.
#include "query/worker_pool.h"
#include "server/daemon_fixture.h"

#include <cstring>
#include <future>
#include <thread>

namespace {

using namespace brdf;
using namespace brdf::service;

/// Keeps a worker busy until it is let go.
struct Gate {
  void hold(WorkerPool& pool, std::uint64_t cost = 1) {
    std::promise<void> begun;
    ASSERT_TRUE(pool.submit(cost, [this, &begun] {
      begun.set_value();
      open.get_future().wait();
    }));
    begun.get_future().wait();
  }
  std::promise<void> open;
};

TEST(WorkerPool, BoundedInCost) {
  WorkerPool pool(1, 100);
  Gate gate;
  gate.hold(pool, 10);
  EXPECT_TRUE(pool.submit(80, [] {}));
  EXPECT_FALSE(pool.submit(11, [] {}));
  EXPECT_TRUE(pool.submit(10, [] {}));
  EXPECT_FALSE(pool.submit(1, [] {}));
  EXPECT_EQ(pool.load(), 100U);
  gate.open.set_value();
  while (pool.load() != 0) std::this_thread::yield();
  EXPECT_TRUE(pool.submit(1000, [] {})) << "an empty queue takes one job of any size";
}

TEST(WorkerPool, RunsWhatIsQueuedBeforeItEnds) {
  int runs = 0;
  {
    WorkerPool pool(1, 1000);
    Gate gate;
    gate.hold(pool);
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(pool.submit(1, [&runs] { ++runs; }));
    gate.open.set_value();
  }
  EXPECT_EQ(runs, 100);
}

v1::EvaluateRequest request(std::uint32_t count) {
  v1::EvaluateRequest r;
  r.set_material("materials/a");
  r.set_operations(v1::OPERATION_EVALUATE);
  r.set_count(count);
  std::string planes(std::size_t{count} * 12, '\0');
  const float one = 1;
  for (std::size_t i = 2 * std::size_t{count}; i < 3 * std::size_t{count}; ++i) std::memcpy(planes.data() + 4 * i, &one, 4);
  r.set_wi(planes);
  r.set_wo(planes);
  return r;
}

TEST(Overload, IsRefusedAtOnceWithPushback) {
  test::Served s;
  s.settings.workers = 1;
  s.settings.max_batch_queries = 1000;
  s.settings.queue_queries = 1000;
  s.put("a", test::golden("rgb-lobes"));
  Serving& serving = s.start().serving();
  Gate gate;
  gate.hold(serving.workers, 900);
  test::Context context;
  v1::EvaluateResponse response;
  const auto start = std::chrono::steady_clock::now();
  const grpc::Status status = s.stub->Evaluate(&context, request(200), &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto pushback = trailers.find("grpc-retry-pushback-ms");
  ASSERT_NE(pushback, trailers.end());
  EXPECT_GE(std::stoi(std::string(pushback->second.data(), pushback->second.size())), 10);
  gate.open.set_value();
  while (serving.workers.load() != 0) std::this_thread::yield();
  test::Context again;
  EXPECT_TRUE(s.stub->Evaluate(&again, request(200), &response).ok());
  EXPECT_NE(serving.metrics.text().find("brdfd_refused_total{reason=\"queue\"} 1"), std::string::npos);
}

TEST(Deadline, WhatExpiredInTheQueueIsNotWorkedOn) {
  test::Served s;
  s.settings.workers = 1;
  s.put("a", test::golden("rgb-lobes"));
  Serving& serving = s.start().serving();
  Gate gate;
  gate.hold(serving.workers);
  test::Context context(std::chrono::milliseconds(100));
  v1::EvaluateResponse response;
  EXPECT_EQ(s.stub->Evaluate(&context, request(500), &response).error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  gate.open.set_value();
  while (serving.workers.load() != 0) std::this_thread::yield();
  EXPECT_EQ(serving.metrics.text().find("brdfd_queries_total{operation=\"evaluate\"} 500"), std::string::npos);
}

TEST(Deadline, LongBatchesStopWithin) {
  const Material material = Material::decode(test::golden("rgb-slices"));
  v1::EvaluateRequest r = request(100 * stop_interval);
  v1::EvaluateResponse response;
  int asked = 0;
  EXPECT_FALSE(answer_batch(material, plan_batch(r, {}), r, response, [&asked] { return ++asked == 3; }));
  EXPECT_EQ(asked, 3);
}

}  // namespace
