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
    // A client has its answer before the pool has the cost back.
    while (pool.load() != 0) std::this_thread::yield();
    // The job outlives what is on the stack here: it holds both ends itself.
    const auto begun = std::make_shared<std::promise<void>>();
    ASSERT_TRUE(pool.submit(cost, [begun, opened = open.get_future().share()] {
      begun->set_value();
      opened.wait();
    }));
    begun->get_future().wait();
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

TEST(WorkerPool, RunsHereOnlyWhereNothingWaitsOrRuns) {
  WorkerPool pool(1, 100);
  std::thread::id where;
  std::uint64_t load = 0;
  bool second = true;
  EXPECT_TRUE(pool.run_if_idle(7, [&] {
    where = std::this_thread::get_id();
    load = pool.load();
    second = pool.run_if_idle(1, [] {});
  }));
  EXPECT_EQ(where, std::this_thread::get_id());
  EXPECT_EQ(load, 7U) << "it counts while it runs";
  EXPECT_FALSE(second);
  EXPECT_EQ(pool.load(), 0U);
  Gate gate;
  gate.hold(pool);
  EXPECT_FALSE(pool.run_if_idle(1, [] { FAIL(); }));
  gate.open.set_value();
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

/// One worker, and no more than a thousand queries in all.
struct ShortQueue : test::Served {
  ShortQueue() {
    settings.workers = 1;
    settings.max_batch_queries = settings.queue_queries = 1000;
    put("a", test::golden("rgb-lobes"));
  }
};

TEST(Overload, IsRefusedAtOnceWithPushback) {
  ShortQueue s;
  Serving& serving = s.start().serving();
  Gate gate;
  gate.hold(serving.workers, 900);
  test::Context context;
  v1::EvaluateResponse response;
  // While the gate is shut nothing but an answer at once comes before the deadline.
  const grpc::Status status = s.stub->Evaluate(&context, request(200), &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
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

TEST(Overload, BriefCallsAreRefusedLikeOthers) {
  ShortQueue s;
  Serving& serving = s.start().serving();
  v1::EvaluateResponse response;
  for (int i = 0; i < 2; ++i) {  // the second finds the tables ready
    test::Context context;
    EXPECT_TRUE(s.stub->Evaluate(&context, request(10), &response).ok());
  }
  Gate gate;
  gate.hold(serving.workers, 995);
  test::Context context;
  EXPECT_EQ(s.stub->Evaluate(&context, request(10), &response).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  gate.open.set_value();
}

TEST(Drain, EndsStreamsThatNobodyWritesTo) {
  test::Served s;
  s.settings.drain_timeout_seconds = 60;
  s.put("a", test::golden("rgb-lobes"));
  Daemon& daemon = s.start();
  test::Context context(std::chrono::seconds(60));
  const auto stream = s.stub->EvaluateStream(&context);
  v1::EvaluateStreamRequest message;
  *message.mutable_request() = request(10);
  v1::EvaluateStreamResponse answer;
  ASSERT_TRUE(stream->Write(message));
  ASSERT_TRUE(stream->Read(&answer));
  const auto start = std::chrono::steady_clock::now();
  daemon.drain(false);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::duration<double>(s.settings.drain_timeout_seconds));
  EXPECT_FALSE(stream->Read(&answer));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
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
