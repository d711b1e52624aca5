// SPDX-License-Identifier: Apache-2.0
// Answers that strangers' files or requests could make larger than a message, and places that they could fill.
#include "server/running_daemon.h"
#include "support/expect_error.h"

#include <brdf/analytic.h>
#include <brdf/encode.h>
#include <brdf/v1/admin_service.grpc.pb.h>

#include <set>

namespace {

using namespace brdf;

std::vector<std::byte> talkative(std::size_t text) {
  Provenance p;
  p.name = p.format = p.description = p.licence = std::string(text, 'x');
  return pack_analytic(Lambert{{0.5F, 0.5F, 0.5F}}, &p);
}

TEST(ListMaterials, PagesStayMessagesWhateverTheFilesSay) {
  test::Served s;
  s.settings.max_message_bytes = 65536;
  const auto file = talkative(4000);
  constexpr int files = 20;  // 16 kB of metadata each
  for (int i = 0; i < files; ++i) s.put("m" + std::to_string(i), file);
  s.start();
  v1::ListMaterialsRequest request;
  request.set_page_size(1000);
  std::set<std::string> names;
  int pages = 0;
  do {
    test::Context context;
    v1::ListMaterialsResponse page;
    const grpc::Status status = s.stub->ListMaterials(&context, request, &page);
    ASSERT_TRUE(status.ok()) << status.error_message();
    EXPECT_LT(page.ByteSizeLong(), 65536U);
    for (const v1::Material& m : page.materials()) EXPECT_TRUE(names.insert(m.name()).second) << "twice: " << m.name();
    request.set_page_token(page.next_page_token());
    ++pages;
  } while (!request.page_token().empty() && pages < files + 1);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(files));
  EXPECT_GT(pages, 4);
}

TEST(Repository, PublishingKeepsToTheNumberOfMaterials) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  service::Repository r(s.settings.repository, service::RepositoryMode::poll, {1, {}});
  r.poll();
  test::expect_error(ErrorCode::limit_exceeded, {"max_materials"}, [&] { r.publish("b", test::golden("rgb-slices"), false); });
  EXPECT_FALSE(std::filesystem::exists(s.folder / "materials/b.brdfc"));
  r.publish("a", test::golden("rgb-slices"), true);
}

TEST(Admin, ManyBadFilesFitIntoAnAnswer) {
  test::Served s;
  s.settings.admin_listen = "unix:" + (s.folder / "admin").string();
  for (int i = 0; i < 1500; ++i) test::put_text(s.folder / ("materials/bad" + std::to_string(i) + ".brdfc").c_str(), "x");
  s.start();
  test::Context context;
  v1::ReloadRepositoryResponse response;
  const auto admin = v1::AdminService::NewStub(grpc::CreateChannel(s.settings.admin_listen, grpc::InsecureChannelCredentials()));
  ASSERT_TRUE(admin->ReloadRepository(&context, {}, &response).ok());
  EXPECT_EQ(response.refused_size(), 1000);
}

TEST(FindSimilar, DamagedUploadsAreRefusedAndCostNothingElse) {
  test::Served s;
  s.put("a", test::golden("rgb-slices"));
  s.start();
  const auto& good = test::golden("rgb-reciprocal-layers");
  std::string bytes(reinterpret_cast<const char*>(good.data()), good.size());
  const auto ask = [&](const std::string& file) {
    test::Context context;
    v1::FindSimilarRequest request;
    request.set_file(file);
    v1::FindSimilarResponse response;
    return s.stub->FindSimilar(&context, request, &response).error_code();
  };
  EXPECT_EQ(ask(bytes), grpc::StatusCode::OK);
  EXPECT_EQ(ask(""), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ask(std::string(3 << 20, '\0')), grpc::StatusCode::INVALID_ARGUMENT);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    const grpc::StatusCode code = ask(damaged);
    EXPECT_TRUE(code == grpc::StatusCode::INVALID_ARGUMENT || code == grpc::StatusCode::DATA_LOSS || code == grpc::StatusCode::UNIMPLEMENTED || code == grpc::StatusCode::RESOURCE_EXHAUSTED)
        << "byte " << i << ": " << code;
  }
  EXPECT_EQ(ask(bytes), grpc::StatusCode::OK);
}

struct Upload {
  explicit Upload(test::Served& s) : stream(s.stub->Compress(&context)) {
    v1::CompressRequest request;
    request.mutable_options()->set_name("materials/new");
    stream->Write(request);
  }
  grpc::Status end() {
    v1::CompressResponse response;
    while (stream->Read(&response)) {
    }
    return stream->Finish();
  }
  test::Context context{std::chrono::minutes(2)};
  std::unique_ptr<grpc::ClientReaderWriter<v1::CompressRequest, v1::CompressResponse>> stream;
};

test::Served& compressing(test::Served& s, double seconds) {
  s.settings.compress_program = "/bin/false";
  s.settings.compress_folder = (s.folder / "uploads").string();
  s.settings.compress_jobs = s.settings.compress_waiting = 1;
  s.settings.compress_seconds = seconds;
  std::filesystem::create_directory(s.folder / "uploads");
  s.start();
  return s;
}

TEST(Compress, UploadsThatNeverEndAreEnded) {
  test::Served s;
  Upload stalled(compressing(s, 1));
  const grpc::Status status = stalled.end();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED) << status.error_message();
  EXPECT_NE(status.error_message().find("upload"), std::string::npos);
  EXPECT_TRUE(test::until([&] { return s.daemon->serving().compress_calls == 0; }));
  EXPECT_TRUE(std::filesystem::is_empty(s.folder / "uploads"));
}

TEST(Compress, NoMoreUploadsAtOnceThanMayWait) {
  test::Served s;
  compressing(s, 600);
  const std::atomic<std::uint64_t>& calls = s.daemon->serving().compress_calls;
  Upload one(s);
  auto two = std::make_optional<Upload>(s);
  ASSERT_TRUE(test::until([&] { return calls == 2; }));
  EXPECT_EQ(Upload(s).end().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  two->context.TryCancel();
  EXPECT_EQ(two->end().error_code(), grpc::StatusCode::CANCELLED);
  ASSERT_TRUE(test::until([&] { return calls == 1; }));
  Upload three(s);
  v1::CompressRequest chunk;
  chunk.set_chunk("no measurement");
  three.stream->Write(chunk);
  three.stream->WritesDone();
  EXPECT_NE(three.end().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << "it came as far as the program, which fails";
  EXPECT_TRUE(test::until([&] { return calls == 1; }));
}

TEST(Compress, RefusedCallsTakeNoPlace) {
  test::Served s;
  test::put_text(s.folder / "tokens", "read 0123456789abcdef\n");
  std::filesystem::permissions(s.folder / "tokens", std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  s.settings.tokens = (s.folder / "tokens").string();
  compressing(s, 600);
  const Upload refused(s);
  v1::CompressResponse response;
  EXPECT_FALSE(refused.stream->Read(&response));
  EXPECT_EQ(s.daemon->serving().compress_calls, 0U) << "although the call is not over";
  EXPECT_EQ(refused.stream->Finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

/// A program that compresses for ever.
void be_slow(test::Served& s) {
  test::put_text(s.folder / "slow", "#!/bin/sh\nsleep 1000\n");
  std::filesystem::permissions(s.folder / "slow", std::filesystem::perms::owner_all);
  s.settings.compress_program = (s.folder / "slow").string();
}

TEST(Compress, ADrainIsNoCancellation) {
  test::Served s;
  compressing(s, 600);
  be_slow(s);
  s.start();
  Upload upload(s);
  v1::CompressRequest chunk;
  chunk.set_chunk("a measurement");
  upload.stream->Write(chunk);
  upload.stream->WritesDone();
  v1::CompressResponse response;
  ASSERT_TRUE(upload.stream->Read(&response)) << "it waits or runs";
  std::thread drain([&] { s.daemon->drain(std::atomic<bool>{false}); });
  EXPECT_EQ(upload.end().error_code(), grpc::StatusCode::UNAVAILABLE) << "another replica can do it";
  drain.join();
  EXPECT_TRUE(std::filesystem::is_empty(s.folder / "uploads"));
}

TEST(Client, ExceptionsOfProgressComeThrough) {
  test::Served s;
  compressing(s, 600);
  client::Client client(s.client_options());
  v1::CompressOptions options;
  options.set_name("materials/new");
  const std::vector<std::byte> file(1 << 20);
  struct Stop {};
  EXPECT_THROW(client.compress(options, file, [](const std::string&, double) -> bool { throw Stop(); }, std::chrono::minutes(1)), Stop);
  EXPECT_TRUE(test::until([&] { return s.daemon->serving().compress_calls == 0; }));
}

TEST(EvaluateStream, MessagesThatCannotBeReadAreNoEnd) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  s.start();
  test::Context context;
  const auto stream = s.stub->EvaluateStream(&context);
  v1::EvaluateStreamRequest request;
  request.mutable_request()->set_material("caf\xe9");  // Latin-1, which protobuf writes and does not read
  stream->Write(request);
  stream->WritesDone();
  v1::EvaluateStreamResponse response;
  EXPECT_FALSE(stream->Read(&response));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  client::Client client(s.client_options());
  EXPECT_THROW(client.evaluate_stream([&](v1::EvaluateRequest& r) { return r = request.request(), true; }, [](std::uint64_t, const v1::EvaluateResponse&) { FAIL(); }, std::chrono::minutes(1)),
               client::CallError);
}

}  // namespace
