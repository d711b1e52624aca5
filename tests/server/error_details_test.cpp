// SPDX-License-Identifier: Apache-2.0
// What a program reads of a failed call: reason, field and when to come back, as google.rpc has them.
#include "server/batch.h"

#include "rpc/error_details.h"
#include "shared/excerpt.h"

#include <google/protobuf/any.pb.h>
#include <google/protobuf/duration.pb.h>
#include <google/protobuf/unknown_field_set.h>

#include <future>
#include <map>

namespace {

using namespace brdf;
using grpc::StatusCode;

/// The bytes of every field of a message, by number.
std::multimap<int, std::string> fields_of(const std::string& wire) {
  google::protobuf::UnknownFieldSet set;
  EXPECT_TRUE(set.ParseFromString(wire));
  std::multimap<int, std::string> fields;
  for (int i = 0; i < set.field_count(); ++i) {
    const auto& f = set.field(i);
    const bool is_number = f.type() == google::protobuf::UnknownField::TYPE_VARINT;
    fields.emplace(f.number(), is_number ? std::to_string(f.varint()) : f.length_delimited());
  }
  return fields;
}

struct Details {
  std::string code, message, reason, domain, field, description;
  google::protobuf::Duration retry;
};

Details details_of(const grpc::Status& status) {
  const auto at = [](const std::multimap<int, std::string>& fields, int number) { return fields.count(number) == 1 ? fields.find(number)->second : std::string(); };
  Details d;
  const auto outer = fields_of(status.error_details());
  d.code = at(outer, 1);
  d.message = at(outer, 2);
  for (auto [one, end] = outer.equal_range(3); one != end; ++one) {
    google::protobuf::Any any;
    EXPECT_TRUE(any.ParseFromString(one->second));
    const auto inner = fields_of(any.value());
    if (any.type_url() == "type.googleapis.com/google.rpc.ErrorInfo") {
      d.reason = at(inner, 1);
      d.domain = at(inner, 2);
    } else if (any.type_url() == "type.googleapis.com/google.rpc.BadRequest") {
      const auto violation = fields_of(at(inner, 1));
      d.field = at(violation, 1);
      d.description = at(violation, 2);
    } else if (any.type_url() == "type.googleapis.com/google.rpc.RetryInfo") {
      EXPECT_TRUE(d.retry.ParseFromString(at(inner, 1)));
    } else {
      ADD_FAILURE() << any.type_url();
    }
  }
  EXPECT_EQ(d.code, std::to_string(status.error_code()));
  EXPECT_EQ(d.message, status.error_message());
  EXPECT_EQ(d.domain, "brdf.v1");
  return d;
}

TEST(ErrorDetails, NameReasonAndField) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  s.start();
  const auto evaluate = [&](const std::function<void(v1::EvaluateRequest&)>& spoil) {
    test::Batch b(4);
    spoil(b.request);
    const grpc::Status status = test::evaluate(s, b.request);
    EXPECT_FALSE(status.ok());
    return details_of(status);
  };
  const Details count = evaluate([](auto& r) { r.set_count(0); });
  EXPECT_EQ(count.reason, "INVALID_ARGUMENT");
  EXPECT_EQ(count.field, "count");
  EXPECT_EQ(count.description, count.message);
  EXPECT_EQ(evaluate([](auto& r) { r.set_operations(64); }).field, "operations");
  EXPECT_EQ(evaluate([](auto& r) { r.set_wi("short"); }).field, "wi");
  EXPECT_EQ(evaluate([](auto& r) { r.set_prefix_bytes(1); }).field, "prefix_bytes");
  EXPECT_EQ(evaluate([](auto& r) { r.set_material("../gold"); }).field, "material");
  EXPECT_EQ(evaluate([](auto& r) { r.mutable_wo()->assign(48, '\x7f'); }).field, "wo");
  EXPECT_EQ(evaluate([](auto& r) { r.set_level(static_cast<v1::EvalLevel>(77)); }).field, "level");

  const Details gone = evaluate([](auto& r) { r.set_material("materials/none"); });
  EXPECT_EQ(gone.reason, "MATERIAL_NOT_FOUND");
  EXPECT_EQ(gone.field, "");
  EXPECT_EQ(evaluate([](auto& r) { r.set_material("materials/a/versions/00000000000000000000000000000000"); }).reason, "VERSION_NOT_FOUND");
  EXPECT_EQ(evaluate([](auto& r) { r.set_count(1U << 31); }).reason, "LIMIT_EXCEEDED");

  v1::FindSimilarRequest similar;
  similar.set_file("no material");
  v1::FindSimilarResponse response;
  test::Context context;
  EXPECT_EQ(details_of(s.stub->FindSimilar(&context, similar, &response)).reason, "NOT_RECOGNIZED");
}

TEST(ErrorDetails, SayWhenToComeBack) {
  test::Served s;
  s.settings.workers = 1;
  s.settings.max_batch_queries = s.settings.queue_queries = 100;
  s.put("a", test::golden("rgb-lobes"));
  service::WorkerPool& workers = s.start().serving().workers;
  std::promise<void> open;
  workers.submit(100, [gate = open.get_future().share()] { gate.wait(); });
  test::Context context;
  v1::EvaluateResponse response;
  const Details full = details_of(s.stub->Evaluate(&context, test::Batch(10).request, &response));
  EXPECT_EQ(full.reason, "QUEUE_FULL");
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto pushback = trailers.find("grpc-retry-pushback-ms");
  ASSERT_NE(pushback, trailers.end());
  EXPECT_EQ(std::to_string(full.retry.seconds() * 1000 + full.retry.nanos() / 1'000'000), std::string(pushback->second.data(), pushback->second.size()));
  open.set_value();
}

TEST(ErrorDetails, LongSentencesFitIntoMetadata) {
  const grpc::Status status = service::detailed_status(StatusCode::INVALID_ARGUMENT, std::string(1023, 'x') + "\xc3\xb6" + std::string(1 << 20, 'y'), {"R", "f", {}});
  EXPECT_EQ(status.error_message(), std::string(1023, 'x'));
  EXPECT_LT(status.error_details().size(), 3000U);
  EXPECT_EQ(service::utf8_prefix("\xc3\xb6", 1), "");
  EXPECT_EQ(service::utf8_prefix("a\xc3\xb6", 3), "a\xc3\xb6");

  test::Served s;
  s.settings.compress_program = "/bin/true";
  s.start();
  // A name of a megabyte: the answer must say so, and must not break the client's limit of metadata.
  test::Context context;
  const auto stream = s.stub->Compress(&context);
  v1::CompressRequest request;
  request.mutable_options()->set_name(std::string(1 << 20, '%'));
  stream->Write(request);
  EXPECT_EQ(details_of(stream->Finish()).field, "options.name");
  v1::GetMaterialRequest get;
  get.set_name(std::string(1 << 20, '%'));
  v1::GetMaterialResponse response;
  test::Context second;
  const grpc::Status answer = s.stub->GetMaterial(&second, get, &response);
  EXPECT_EQ(answer.error_code(), StatusCode::INVALID_ARGUMENT) << answer.error_message();
  EXPECT_EQ(details_of(answer).field, "name");
}

}  // namespace
