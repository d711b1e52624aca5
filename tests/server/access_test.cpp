// SPDX-License-Identifier: Apache-2.0
// Roles of bearer tokens for every call of the running daemon, and the admin service on its own listener.
#include "server/running_daemon.h"

#include <brdf/v1/admin_service.grpc.pb.h>

#include <map>

namespace {

using namespace brdf;
using grpc::StatusCode;
using test::Words;

/// A call of each method that stops at once; its status says who may.
using Ask = std::function<grpc::Status(grpc::ClientContext&)>;

template <class Stream>
grpc::Status end_of(const std::unique_ptr<Stream>& stream) {
  return stream->Finish();
}

std::map<std::string, Ask> calls(v1::BrdfService::Stub& stub) {
  return {
      {"ListMaterials", [&](grpc::ClientContext& c) { v1::ListMaterialsResponse r; return stub.ListMaterials(&c, {}, &r); }},
      {"GetMaterial", [&](grpc::ClientContext& c) { v1::GetMaterialResponse r; return stub.GetMaterial(&c, {}, &r); }},
      {"Evaluate", [&](grpc::ClientContext& c) { v1::EvaluateResponse r; return stub.Evaluate(&c, {}, &r); }},
      {"Albedo", [&](grpc::ClientContext& c) { v1::AlbedoResponse r; return stub.Albedo(&c, {}, &r); }},
      {"FindSimilar", [&](grpc::ClientContext& c) { v1::FindSimilarResponse r; return stub.FindSimilar(&c, {}, &r); }},
      {"DownloadMaterial", [&](grpc::ClientContext& c) { return end_of(stub.DownloadMaterial(&c, {})); }},
      {"EvaluateStream",
       [&](grpc::ClientContext& c) {
         const auto stream = stub.EvaluateStream(&c);
         stream->WritesDone();
         return end_of(stream);
       }},
      {"WatchMaterials",
       [&](grpc::ClientContext& c) {
         const auto stream = stub.WatchMaterials(&c, {});
         v1::WatchMaterialsResponse first;
         if (stream->Read(&first)) c.TryCancel();
         return end_of(stream);
       }},
      {"Compress",
       [&](grpc::ClientContext& c) {
         const auto stream = stub.Compress(&c);
         stream->WritesDone();
         return end_of(stream);
       }},
  };
}

std::map<std::string, Ask> calls(v1::AdminService::Stub& stub) {
  return {
      {"LoadMaterial", [&](grpc::ClientContext& c) { v1::LoadMaterialResponse r; return stub.LoadMaterial(&c, {}, &r); }},
      {"UnloadMaterial", [&](grpc::ClientContext& c) { v1::UnloadMaterialResponse r; return stub.UnloadMaterial(&c, {}, &r); }},
      {"ReloadRepository", [&](grpc::ClientContext& c) { v1::ReloadRepositoryResponse r; return stub.ReloadRepository(&c, {}, &r); }},
  };
}

TEST(Access, EveryCallNeedsItsRole) {
  test::RunningDaemon d;
  d.put_secret("tokens", "read the-readers-token\ncompress the-compressors-token\nadmin the-admins-token\n");
  const std::string admin_address = "unix:" + d.place("admin");
  d.start({"--listen", d.socket(), "--admin-listen", admin_address, "--tokens", d.place("tokens"), "--log-level", "debug"});
  const auto brdf = v1::BrdfService::NewStub(test::fresh_channel(d.addresses[0]));
  const auto admin = v1::AdminService::NewStub(test::fresh_channel(admin_address));
  const Words tokens{"", "not-a-token-of-this-server", "the-readers-token", "the-compressors-token", "the-admins-token"};
  const auto expect = [&](const std::string& name, const Ask& ask, std::size_t first_allowed) {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      test::Context context;
      if (!tokens[i].empty()) context.AddMetadata("authorization", "Bearer " + tokens[i]);
      const StatusCode code = ask(context).error_code();
      if (i < 2) {
        EXPECT_EQ(code, StatusCode::UNAUTHENTICATED) << name << ' ' << tokens[i];
      } else if (i < first_allowed) {
        EXPECT_EQ(code, StatusCode::PERMISSION_DENIED) << name << ' ' << tokens[i];
      } else {
        EXPECT_TRUE(code == StatusCode::OK || code == StatusCode::INVALID_ARGUMENT || code == StatusCode::CANCELLED || code == StatusCode::UNIMPLEMENTED)
            << name << ' ' << tokens[i] << ' ' << code;
      }
    }
  };
  for (const auto& [name, ask] : calls(*brdf)) expect(name, ask, name == "Compress" ? 3 : 2);
  for (const auto& [name, ask] : calls(*admin)) expect(name, ask, 4);
  for (std::size_t i = 1; i < tokens.size(); ++i) EXPECT_EQ(d.process->log().find(tokens[i]), std::string::npos) << "a token in the log";
}

TEST(Access, TheAdminServiceIsServedOnItsOwnListenerAlone) {
  test::RunningDaemon d;
  d.start({"--listen", d.socket(), "--admin-listen", "127.0.0.1:0"});
  const auto reload = [](const std::string& address) {
    test::Context context;
    v1::ReloadRepositoryResponse response;
    return v1::AdminService::NewStub(test::fresh_channel(address))->ReloadRepository(&context, {}, &response).error_code();
  };
  const std::string admin = d.logged("admin.listening", "address");
  EXPECT_EQ(reload(admin), StatusCode::OK);
  EXPECT_EQ(reload(d.addresses[0]), StatusCode::UNIMPLEMENTED);
  EXPECT_EQ(test::ask(test::fresh_channel(admin)).error_code(), StatusCode::UNIMPLEMENTED);
  EXPECT_EQ(test::run_brdfd({"--health-check", admin}).output, "SERVING\n");
}

TEST(Admin, LoadsUnloadsAndReloads) {
  test::RunningDaemon d;
  const std::string address = "unix:" + d.place("admin");
  d.start({"--listen", d.socket(), "--admin-listen", address, "--repository-mode", "explicit"});
  const auto channel = test::fresh_channel(d.addresses[0]);
  const auto admin = v1::AdminService::NewStub(test::fresh_channel(address));
  const auto load = [&](const std::string& name) {
    test::Context context;
    v1::LoadMaterialRequest request;
    request.set_name(name);
    v1::LoadMaterialResponse response;
    return admin->LoadMaterial(&context, request, &response).error_code();
  };
  const auto unload = [&](const std::string& name) {
    test::Context context;
    v1::UnloadMaterialRequest request;
    request.set_name(name);
    v1::UnloadMaterialResponse response;
    return admin->UnloadMaterial(&context, request, &response).error_code();
  };
  EXPECT_EQ(test::ask(channel).error_code(), StatusCode::NOT_FOUND) << "nothing is loaded yet";
  EXPECT_EQ(load("materials/gold"), StatusCode::OK);
  EXPECT_EQ(test::ask(channel).error_code(), StatusCode::OK);
  EXPECT_NE(load("materials/none"), StatusCode::OK);
  for (const char* bad : {"gold", "materials/../gold", "materials/gold/versions/00000000000000000000000000000000", ""}) {
    EXPECT_EQ(load(bad), StatusCode::INVALID_ARGUMENT) << bad;
    EXPECT_EQ(unload(bad), StatusCode::INVALID_ARGUMENT) << bad;
  }

  test::put_text(d.folder / "materials/gold.brdfc", "no material");
  d.put("silver", test::golden("rgb-slices"));
  test::Context context;
  v1::ReloadRepositoryResponse reloaded;
  ASSERT_TRUE(admin->ReloadRepository(&context, {}, &reloaded).ok());
  EXPECT_EQ(reloaded.materials(), 1U) << "what was not loaded stays so";
  ASSERT_EQ(reloaded.refused_size(), 1);
  EXPECT_EQ(reloaded.refused(0).name(), "materials/gold");
  EXPECT_EQ(test::ask(channel).error_code(), StatusCode::OK) << "the version before goes on";

  EXPECT_EQ(unload("materials/gold"), StatusCode::OK);
  EXPECT_EQ(unload("materials/gold"), StatusCode::NOT_FOUND);
  EXPECT_EQ(test::ask(channel).error_code(), StatusCode::NOT_FOUND);
  EXPECT_TRUE(std::filesystem::exists(d.folder / "materials/gold.brdfc"));
}

}  // namespace
