// SPDX-License-Identifier: Apache-2.0
// Batches, against what the library says in process.
#include "server/batch.h"
#include "shared/content_hash.h"
#include "shared/material_name.h"

#include <limits>

namespace {

using namespace brdf;
using namespace brdf::service;
using namespace brdf::test;
using grpc::StatusCode;

TEST(Evaluate, AnswersWhatTheLibraryAnswersToTheBit) {
  test::Served s;
  const char* names[] = {"rgb-slices", "spectral-coded-lobes", "rgb-reciprocal-layers"};
  for (const char* name : names) s.put(name, test::golden(name));
  s.start();
  for (const char* name : names) {
    for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
      Batch b(3000, material_name(name));
      b.request.set_level(static_cast<v1::EvalLevel>(static_cast<int>(level) + 1));
      v1::EvaluateResponse answer;
      const grpc::Status status = evaluate(s, b.request, &answer);
      ASSERT_TRUE(status.ok()) << status.error_message();
      DecodeOptions options;
      options.level = level;
      const Material m = Material::decode(test::golden(name), options);
      const auto c = static_cast<std::size_t>(m.channels());
      std::vector<float> f(c * b.n), pdf(b.n), wi(3 * b.n), sample_pdf(b.n), weight(c * b.n);
      m.eval_pdf(span_of(b.wi), span_of(b.wo), {f.data(), b.n}, pdf.data());
      m.sample(span_of(b.wo), span_of(b.u), {wi.data(), wi.data() + b.n, wi.data() + 2 * b.n, b.n}, sample_pdf.data(), {weight.data(), b.n});
      EXPECT_EQ(answer.values(), bytes_of(f)) << name;
      EXPECT_EQ(answer.pdf(), bytes_of(pdf)) << name;
      EXPECT_EQ(answer.sample_wi(), bytes_of(wi)) << name;
      EXPECT_EQ(answer.sample_pdf(), bytes_of(sample_pdf)) << name;
      EXPECT_EQ(answer.sample_weight(), bytes_of(weight)) << name;
      EXPECT_EQ(answer.version(), version_name(name, version_of(test::golden(name))));
      EXPECT_EQ(answer.channels(), c);
    }
  }
}

TEST(Evaluate, OneDirectionStandsForAll) {
  test::Served s;
  s.put("a", test::golden("rgb-slices"));
  s.start();
  Batch b(2000);
  b.request.set_operations(v1::OPERATION_EVALUATE);
  b.request.clear_random();
  const std::vector<float> one{0.6F, 0, 0.8F};
  b.request.set_wo(bytes_of(one));
  v1::EvaluateResponse single, many;
  ASSERT_TRUE(evaluate(s, b.request, &single).ok());
  std::vector<float> repeated;
  for (const float v : one) repeated.insert(repeated.end(), b.n, v);
  b.request.set_wo(bytes_of(repeated));
  ASSERT_TRUE(evaluate(s, b.request, &many).ok());
  EXPECT_EQ(single.values(), many.values());
}

TEST(Evaluate, PrefixesAnswerAsTheirFile) {
  test::Served s;
  const auto& bytes = test::golden("rgb-reciprocal-layers");
  s.put("a", bytes);
  s.start();
  const std::uint64_t cut = refinement_boundaries(bytes).front();
  Batch b(100);
  b.request.set_operations(v1::OPERATION_EVALUATE);
  b.request.clear_random();
  b.request.set_prefix_bytes(cut);
  v1::EvaluateResponse answer;
  ASSERT_TRUE(evaluate(s, b.request, &answer).ok());
  DecodeOptions options;
  options.allow_prefix = true;
  const Material m = Material::decode(std::span(bytes).first(cut), options);
  std::vector<float> f(3 * b.n);
  m.eval(span_of(b.wi), span_of(b.wo), {f.data(), b.n});
  EXPECT_EQ(answer.values(), bytes_of(f));
  EXPECT_EQ(answer.error().refinement(), 0);
  b.request.set_prefix_bytes(cut + 1);
  EXPECT_EQ(evaluate(s, b.request).error_code(), StatusCode::INVALID_ARGUMENT);
}

TEST(Evaluate, BadRequestsAreNamed) {
  test::Served s;
  s.settings.max_batch_queries = 5000;
  s.put("a", test::golden("rgb-lobes"));
  s.put("wide", test::golden("spectral-coded-lobes"));
  s.start();
  const auto refused = [&](StatusCode code, const std::string& word, const auto& change) {
    Batch b(50);
    change(b);
    const grpc::Status status = evaluate(s, b.request);
    EXPECT_EQ(status.error_code(), code) << word << ": " << status.error_message();
    EXPECT_NE(status.error_message().find(word), std::string::npos) << status.error_message();
  };
  constexpr auto bad = StatusCode::INVALID_ARGUMENT;
  refused(bad, "materials/", [](Batch& b) { b.request.set_material("../etc/passwd"); });
  refused(StatusCode::NOT_FOUND, "nothing", [](Batch& b) { b.request.set_material("materials/nothing"); });
  refused(StatusCode::NOT_FOUND, "served as version", [](Batch& b) { b.request.set_material("materials/a/versions/" + std::string(32, '0')); });
  refused(bad, "operations", [](Batch& b) { b.request.set_operations(0); });
  refused(bad, "operations", [](Batch& b) { b.request.set_operations(9); });
  refused(bad, "count", [](Batch& b) { b.request.set_count(0); });
  refused(StatusCode::RESOURCE_EXHAUSTED, "limit of a batch", [](Batch& b) { b.request.set_count(4'000'000'000); });
  refused(bad, "wi", [](Batch& b) { b.request.mutable_wi()->pop_back(); });
  refused(bad, "wo", [](Batch& b) { b.request.clear_wo(); });
  refused(bad, "numbers", [](Batch& b) { b.request.mutable_numbers()->append("abcd"); });
  refused(bad, "seeded", [](Batch& b) { b.request.clear_random(); });
  refused(bad, "level", [](Batch& b) { b.request.set_level(static_cast<v1::EvalLevel>(9)); });
  refused(bad, "transport", [](Batch& b) { b.request.set_transport(static_cast<v1::TransportMode>(9)); });
  const auto with = [](std::vector<float> values, std::size_t i, float v) {
    values[i] = v;
    return bytes_of(values);
  };
  refused(bad, "wi of query 7", [&](Batch& b) { b.request.set_wi(with(b.wi, 7, std::nanf(""))); });
  refused(bad, "wo of query 49", [&](Batch& b) { b.request.set_wo(with(b.wo, 149, std::numeric_limits<float>::infinity())); });
  refused(bad, "wi of query 0", [&](Batch& b) { b.request.set_wi(with(b.wi, 0, 3)); });
  refused(bad, "numbers of query 3", [&](Batch& b) { b.request.set_numbers(with(b.u, 3, 1)); });
  refused(bad, "numbers of query 3", [&](Batch& b) { b.request.set_numbers(with(b.u, 3, -0.1F)); });
}

TEST(Evaluate, ZeroVectorsAreAnsweredWithZero) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  s.start();
  Batch b(10);
  b.request.set_operations(v1::OPERATION_EVALUATE | v1::OPERATION_PDF);
  b.request.clear_random();
  b.request.set_wi(std::string(120, '\0'));
  v1::EvaluateResponse answer;
  ASSERT_TRUE(evaluate(s, b.request, &answer).ok());
  for (const float v : floats_of(answer.values())) EXPECT_EQ(v, 0);
  for (const float v : floats_of(answer.pdf())) EXPECT_EQ(v, 0);
}

TEST(EvaluateStream, AnswersInOrderAndEndsAtTheFirstMistake) {
  test::Served s;
  s.put("a", test::golden("rgb-slices"));
  s.start();
  client::Client client(s.client_options());
  Batch b(700);
  v1::EvaluateResponse expected;
  ASSERT_TRUE(evaluate(s, b.request, &expected).ok());
  std::uint64_t sent = 0, received = 0;
  client.evaluate_stream(
      [&](v1::EvaluateRequest& r) {
        r = b.request;
        return sent++ < 50;
      },
      [&](std::uint64_t id, const v1::EvaluateResponse& r) {
        EXPECT_EQ(id, received++);
        EXPECT_EQ(r.values(), expected.values());
      },
      std::chrono::seconds(30));
  EXPECT_EQ(received, 50U);
  sent = received = 0;
  try {
    client.evaluate_stream(
        [&](v1::EvaluateRequest& r) {
          r = b.request;
          if (sent == 3) r.set_count(1);
          return sent++ < 50;
        },
        [&](std::uint64_t, const v1::EvaluateResponse&) { ++received; }, std::chrono::seconds(30));
    ADD_FAILURE() << "a bad batch went through";
  } catch (const client::CallError& e) {
    EXPECT_EQ(e.code(), StatusCode::INVALID_ARGUMENT) << e.what();
    EXPECT_EQ(e.library_code(), "invalid_argument");
    EXPECT_LE(received, 3U);
  }
}

TEST(Albedo, IsTheLibrarys) {
  test::Served s;
  s.put("a", test::golden("rgb-slices"));
  s.start();
  v1::AlbedoRequest request;
  request.set_material("materials/a");
  request.set_count(1);
  request.set_wo(bytes_of(std::vector<float>{0.6F, 0, 0.8F}));
  v1::AlbedoResponse answer;
  test::Context context;
  ASSERT_TRUE(s.stub->Albedo(&context, request, &answer).ok());
  std::vector<float> albedo(3);
  Material::decode(test::golden("rgb-slices")).albedo({0.6F, 0, 0.8F}, albedo);
  EXPECT_EQ(answer.albedo(), bytes_of(albedo));
}

}  // namespace
