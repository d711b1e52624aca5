// SPDX-License-Identifier: Apache-2.0
// Listing, downloads, watching, roles and health.
#include "server/daemon_fixture.h"
#include "shared/content_hash.h"
#include "shared/material_name.h"

#include <brdf/v1/admin_service.grpc.pb.h>
#include <grpc/health/v1/health.grpc.pb.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

namespace {

using namespace brdf;
using namespace brdf::service;
using grpc::StatusCode;

TEST(ListMaterials, PagesAndFilters) {
  test::Served s;
  for (int i = 0; i < 25; ++i) s.put("m" + std::to_string(100 + i), test::golden(i % 2 == 0 ? "rgb-lobes" : "spectral-coded-lobes"));
  s.start();
  const auto all = [&](v1::ListMaterialsRequest request) {
    std::vector<std::string> names;
    do {
      test::Context context;
      v1::ListMaterialsResponse page;
      EXPECT_TRUE(s.stub->ListMaterials(&context, request, &page).ok());
      EXPECT_LE(page.materials_size(), 4);
      EXPECT_EQ(page.total(), 25U);
      for (const v1::Material& m : page.materials()) names.push_back(m.name());
      request.set_page_token(page.next_page_token());
    } while (!request.page_token().empty());
    return names;
  };
  v1::ListMaterialsRequest request;
  request.set_page_size(4);
  const auto names = all(request);
  EXPECT_EQ(names.size(), 25U);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  request.set_channel_model(v1::CHANNEL_MODEL_SPECTRAL);
  EXPECT_EQ(all(request).size(), 12U);
  request.set_name_contains("m10");
  EXPECT_EQ(all(request).size(), 5U);
  request.set_max_bytes(10);
  EXPECT_TRUE(all(request).empty());
  request.set_page_token("../x");
  test::Context context;
  v1::ListMaterialsResponse page;
  EXPECT_EQ(s.stub->ListMaterials(&context, request, &page).error_code(), StatusCode::INVALID_ARGUMENT);
}

TEST(GetMaterial, SaysWhatTheFileSays) {
  test::Served s;
  const auto& bytes = test::golden("rgb-reciprocal-layers");
  s.put("a", bytes);
  s.start();
  const v1::Material m = client::Client(s.client_options()).get("materials/a");
  const MaterialInfo info = Material::decode(bytes).info();
  EXPECT_EQ(m.bytes(), bytes.size());
  EXPECT_EQ(m.version(), version_name("a", version_of(bytes)));
  ASSERT_EQ(static_cast<std::size_t>(m.errors_size()), info.errors.size());
  for (int i = 0; i < m.errors_size(); ++i) EXPECT_EQ(m.errors(i).log_mae(), info.errors[static_cast<std::size_t>(i)].log_mae);
  const auto ends = refinement_boundaries(bytes);
  ASSERT_EQ(static_cast<std::size_t>(m.refinements_size()), ends.size());
  for (int i = 0; i < m.refinements_size(); ++i) EXPECT_EQ(m.refinements(i).prefix_bytes(), ends[static_cast<std::size_t>(i)]);
}

TEST(Download, ResumesAndCuts) {
  test::Served s;
  const auto& bytes = test::golden("rgb-reciprocal-layers");
  s.put("a", bytes);
  s.start();
  const auto download = [&](const v1::DownloadMaterialRequest& request, v1::DownloadHeader& header) {
    test::Context context;
    auto reader = s.stub->DownloadMaterial(&context, request);
    std::string data;
    v1::DownloadMaterialResponse message;
    while (reader->Read(&message)) {
      if (message.has_header()) header = message.header();
      data += message.chunk();
    }
    return std::pair(data, reader->Finish());
  };
  const std::string whole(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  v1::DownloadMaterialRequest request;
  v1::DownloadHeader header;
  request.set_name("materials/a");
  EXPECT_EQ(download(request, header).first, whole);
  const Sha256 digest = sha256(bytes);
  EXPECT_EQ(header.sha256(), std::string(reinterpret_cast<const char*>(digest.data()), digest.size()));
  request.set_name(header.version());
  for (const std::uint64_t offset : {std::uint64_t{1}, std::uint64_t{100}, std::uint64_t{bytes.size()}}) {
    request.set_offset(offset);
    EXPECT_EQ(download(request, header).first, whole.substr(offset));
  }
  request.set_offset(bytes.size() + 1);
  EXPECT_EQ(download(request, header).second.error_code(), StatusCode::OUT_OF_RANGE);

  const auto ends = refinement_boundaries(bytes);
  request.set_offset(0);
  request.set_max_bytes(ends[0] + 1);
  EXPECT_EQ(download(request, header).first, whole.substr(0, ends[0]));
  request.set_max_bytes(ends[0] - 1);
  EXPECT_EQ(download(request, header).second.error_code(), StatusCode::INVALID_ARGUMENT);
  request.set_max_log_mae(1e9);
  EXPECT_LE(download(request, header).first.size(), whole.size());
  request.set_max_log_mae(0);
  EXPECT_EQ(download(request, header).first, whole);
  request.set_max_log_mae(std::nan(""));
  EXPECT_EQ(download(request, header).second.error_code(), StatusCode::INVALID_ARGUMENT);
}

TEST(Watch, TellsEveryChange) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  service::Daemon& daemon = s.start();
  test::Context context;
  auto reader = s.stub->WatchMaterials(&context, {});
  const auto next = [&] {
    v1::WatchMaterialsResponse message;
    EXPECT_TRUE(reader->Read(&message));
    EXPECT_EQ(message.changes_size(), 1);
    return message.changes_size() == 1 ? std::pair(message.changes(0).kind(), message.changes(0).name()) : std::pair(v1::CHANGE_KIND_UNSPECIFIED, std::string());
  };
  EXPECT_EQ(next(), std::pair(v1::CHANGE_KIND_PRESENT, std::string("materials/a")));
  s.put("b", test::golden("rgb-slices"));
  daemon.reload();
  EXPECT_EQ(next(), std::pair(v1::CHANGE_KIND_ADDED, std::string("materials/b")));
  s.put("a", test::golden("rgb-slices"));
  daemon.reload();
  EXPECT_EQ(next(), std::pair(v1::CHANGE_KIND_REPLACED, std::string("materials/a")));
  std::filesystem::remove(s.folder / "materials/b.brdfc");
  daemon.reload();
  EXPECT_EQ(next(), std::pair(v1::CHANGE_KIND_REMOVED, std::string("materials/b")));
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), StatusCode::CANCELLED);
}

TEST(Watch, CancelledWatchersLeave) {
  test::Served s;
  s.settings.watchers = 1;
  s.put("a", test::golden("rgb-lobes"));
  s.start();
  // Whoever came before has to be gone, whatever their cancellation met: no watcher, a message on its way, one that was read.
  for (int i = 0; i < 1000; ++i) {
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    for (bool taken = false; !taken;) {
      ASSERT_LT(std::chrono::steady_clock::now(), patience) << "watcher " << i << " does not get the place of the one before";
      test::Context context;
      const auto reader = s.stub->WatchMaterials(&context, {});
      v1::WatchMaterialsResponse message;
      taken = i % 3 == 0 || reader->Read(&message);
      if (i % 3 == 1) std::this_thread::sleep_for(std::chrono::microseconds(i % 50));
      context.TryCancel();
      const grpc::Status status = reader->Finish();
      ASSERT_TRUE(status.error_code() == StatusCode::CANCELLED || status.error_code() == StatusCode::RESOURCE_EXHAUSTED) << status.error_message();
    }
  }
}

TEST(Health, CancelledWatchersLeave) {
  service::HealthService health({});
  health.set_serving(true);
  grpc::ServerBuilder builder;
  builder.RegisterService(&health);
  const auto server = builder.BuildAndStart();
  const auto stub = grpc::health::v1::Health::NewStub(server->InProcessChannel({}));
  for (int i = 0; i < 3000; ++i) {
    test::Context context;
    const auto reader = stub->Watch(&context, {});
    grpc::health::v1::HealthCheckResponse response;
    if (i % 3 != 0) reader->Read(&response);
    if (i % 3 == 1) std::this_thread::sleep_for(std::chrono::microseconds(i % 50));
    context.TryCancel();
    reader->Finish();
  }
  const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (health.watching() != 0 && std::chrono::steady_clock::now() < patience) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(health.watching(), 0U);
  health.end();
  server->Shutdown();
}

TEST(Roles, EachCallNeedsItsOwn) {
  test::Served s;
  s.put("a", test::golden("rgb-lobes"));
  test::put_text(s.folder / "tokens", "read 0123456789abcdef\nadmin fedcba9876543210\n");
  std::filesystem::permissions(s.folder / "tokens", std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  s.settings.tokens = (s.folder / "tokens").string();
  s.settings.admin_listen = "unix:" + (s.folder / "admin").string();
  s.start();
  const auto get = [&](const std::vector<std::string>& headers) {
    test::Context context;
    for (const std::string& h : headers) context.AddMetadata("authorization", h);
    v1::GetMaterialRequest request;
    request.set_name("materials/a");
    v1::GetMaterialResponse response;
    return s.stub->GetMaterial(&context, request, &response).error_code();
  };
  EXPECT_EQ(get({}), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(get({"Bearer wrong-wrong-wrong"}), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(get({"Basic 0123456789abcdef"}), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(get({"Bearer 0123456789abcdef", "Bearer 0123456789abcdef"}), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(get({"Bearer 0123456789abcdef"}), StatusCode::OK);
  EXPECT_EQ(get({"Bearer fedcba9876543210"}), StatusCode::OK);

  const auto admin = v1::AdminService::NewStub(grpc::CreateChannel(s.settings.admin_listen, grpc::InsecureChannelCredentials()));
  const auto reload = [&](const std::string& token) {
    test::Context context;
    context.AddMetadata("authorization", "Bearer " + token);
    v1::ReloadRepositoryResponse response;
    return admin->ReloadRepository(&context, {}, &response).error_code();
  };
  EXPECT_EQ(reload("0123456789abcdef"), StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(reload("fedcba9876543210"), StatusCode::OK);

  test::Context context;
  context.AddMetadata("authorization", "Bearer 0123456789abcdef");
  auto compress = s.stub->Compress(&context);
  EXPECT_EQ(compress->Finish().error_code(), StatusCode::PERMISSION_DENIED);
}

TEST(Admin, IsNotOnTheOpenListener) {
  test::Served s;
  s.start();
  test::Context context;
  v1::ReloadRepositoryResponse response;
  EXPECT_EQ(v1::AdminService::NewStub(s.channel)->ReloadRepository(&context, {}, &response).error_code(), StatusCode::UNIMPLEMENTED);
}

TEST(Health, FollowsTheDrain) {
  test::Served s;
  service::Daemon& daemon = s.start();
  const auto health = grpc::health::v1::Health::NewStub(s.channel);
  const auto check = [&](const std::string& name) {
    test::Context context;
    grpc::health::v1::HealthCheckRequest request;
    request.set_service(name);
    grpc::health::v1::HealthCheckResponse response;
    const grpc::Status status = health->Check(&context, request, &response);
    return std::pair(status.error_code(), response.status());
  };
  using Response = grpc::health::v1::HealthCheckResponse;
  EXPECT_EQ(check("brdf.v1.BrdfService"), std::pair(StatusCode::OK, Response::SERVING));
  EXPECT_EQ(check("").second, Response::SERVING);
  EXPECT_EQ(check("other").first, StatusCode::NOT_FOUND);
  test::Context context;
  auto watch = health->Watch(&context, {});
  Response now;
  ASSERT_TRUE(watch->Read(&now));
  EXPECT_EQ(now.status(), Response::SERVING);
  std::thread drain([&] { daemon.drain(std::atomic<bool>{false}); });
  ASSERT_TRUE(watch->Read(&now));
  EXPECT_EQ(now.status(), Response::NOT_SERVING);
  EXPECT_FALSE(watch->Read(&now));
  watch->Finish();
  drain.join();
}

}  // namespace
