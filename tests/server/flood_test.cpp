// SPDX-License-Identifier: Apache-2.0
// A client that opens streams and resets them as fast as it can (CVE-2023-44487) loses its connection, and nobody else does.
#include "server/load/http2_frames.h"
#include "server/load/raw_socket.h"
#include "server/running_daemon.h"

namespace {

using namespace brdf;
namespace http2 = load::http2;

/// Until the other side closes, or this many streams were reset: how many were.
std::uint64_t flood(load::RawSocket socket, const std::string& method, std::uint64_t most) {
  EXPECT_TRUE(socket.open());
  const std::string headers = http2::call_headers("/brdf.v1.BrdfService/" + method, "");
  std::string bytes = std::string(http2::preface) + http2::frame(http2::FrameType::settings, 0, 0, "");
  for (std::uint64_t i = 0; i < most; ++i) {
    const auto stream = static_cast<std::uint32_t>(2 * i + 1);
    bytes += http2::frame(http2::FrameType::headers, http2::end_headers, stream, headers) + http2::frame(http2::FrameType::rst_stream, 0, stream, http2::big_endian(8, 4));
    if (!socket.send(bytes, test::patience) || !socket.drain()) return i;
    bytes.clear();
  }
  return most;
}

/// By what it is connected, and what it calls.
class Flood : public testing::TestWithParam<std::tuple<std::string, std::string>> {};
INSTANTIATE_TEST_SUITE_P(, Flood, testing::Combine(testing::Values("unix", "tcp"), testing::Values("GetMaterial", "EvaluateStream", "NoSuchMethod")),
                         [](const auto& i) { return std::get<0>(i.param) + "_" + std::get<1>(i.param); });

TEST_P(Flood, OfResetStreamsEndsItsConnectionAlone) {
  test::RunningDaemon daemon;
  const auto& [kind, method] = GetParam();
  const bool is_unix = kind == "unix";
  daemon.start({"--listen", is_unix ? daemon.socket() : "127.0.0.1:0", "--max-streams", "10"});
  const std::string address = daemon.addresses.front();
  const auto honest = test::fresh_channel(address);
  ASSERT_TRUE(test::ask(honest).ok());
  constexpr std::uint64_t most = 400'000;
  std::uint64_t reset = most;
  std::atomic<bool> ended{false};
  std::thread hostile([&, called = method] {
    reset = flood(load::RawSocket(address), called, most);
    ended = true;
  });
  do {
    const grpc::Status status = test::ask(honest);
    EXPECT_TRUE(status.ok()) << status.error_message();
  } while (!ended);
  hostile.join();
  EXPECT_LT(reset, most);
  EXPECT_TRUE(test::until([&] { return daemon.process->log().find("connection.cut") != std::string::npos; }));
  EXPECT_TRUE(test::says(daemon.logged("connection.cut", "peer"), is_unix ? "unix, process " + std::to_string(::getpid()) : "127.0.0.1 port "));
  EXPECT_TRUE(test::ask(honest).ok());
}

TEST(StreamGuard, ManyCallsThatAreMeantEndNoConnection) {
  test::RunningDaemon daemon;
  daemon.start({"--listen", daemon.socket(), "--max-streams", "2"});
  const auto stub = v1::BrdfService::NewStub(test::fresh_channel(daemon.socket()));
  for (int i = 0; i < 2000; ++i) {
    test::Context context;
    v1::GetMaterialRequest request;
    request.set_name("materials/gold");
    v1::GetMaterialResponse response;
    if (i % 2 == 0) {  // a renderer whose user changed their mind
      std::atomic<bool> done{false};
      stub->async()->GetMaterial(&context, &request, &response, [&](const grpc::Status&) { done = true; });
      context.TryCancel();
      while (!done) std::this_thread::yield();
    } else {
      const grpc::Status status = stub->GetMaterial(&context, request, &response);
      ASSERT_TRUE(status.ok()) << status.error_message();
    }
  }
  EXPECT_EQ(daemon.process->log().find("connection.cut"), std::string::npos);
}

}  // namespace
