// SPDX-License-Identifier: Apache-2.0
// What whoever operates the daemon does to it: signals, its drain, metrics, where settings come from.
#include "server/running_daemon.h"

#include <grpc/health/v1/health.grpc.pb.h>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>

namespace {

using namespace brdf;
using grpc::StatusCode;
using grpc::health::v1::HealthCheckResponse;
using test::says;
using test::Words;

HealthCheckResponse::ServingStatus health_of(const std::shared_ptr<grpc::Channel>& channel) {
  test::Context context;
  HealthCheckResponse response;
  grpc::health::v1::Health::NewStub(channel)->Check(&context, {}, &response);
  return response.status();
}

std::string page(const std::string& port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string text;
  constexpr std::string_view question = "GET /metrics HTTP/1.0\r\n\r\n";
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof(to)) == 0 && ::write(fd, question.data(), question.size()) > 0) {
    std::array<char, 4096> part;
    for (::ssize_t n; (n = ::read(fd, part.data(), part.size())) > 0;) text.append(part.data(), static_cast<std::size_t>(n));
  }
  ::close(fd);
  return text;
}

TEST(Sighup, ReadsRepositoryAndTokensAgain) {
  test::RunningDaemon d;
  d.put_secret("tokens", "read first-first-first\n");
  d.start({"--listen", d.socket(), "--tokens", d.place("tokens")});
  const auto channel = test::fresh_channel(d.addresses[0]);
  const auto answer = [&](const std::string& token, const std::string& material = "materials/gold") { return test::ask(channel, token, material).error_code(); };
  EXPECT_EQ(answer("first-first-first"), StatusCode::OK);
  EXPECT_EQ(answer("first-first-first", "materials/silver"), StatusCode::NOT_FOUND);

  d.put("silver", test::golden("rgb-slices"));
  d.put_secret("tokens", "read second-second-second\n");
  EXPECT_EQ(answer("second-second-second"), StatusCode::UNAUTHENTICATED) << "nobody has said so yet";
  d.process->signal(SIGHUP);
  EXPECT_TRUE(test::until([&] { return answer("second-second-second", "materials/silver") == StatusCode::OK; })) << d.process->log();
  EXPECT_EQ(answer("first-first-first"), StatusCode::UNAUTHENTICATED);

  test::put_text(d.folder / "materials/gold.brdfc", "no material any more");
  d.put_secret("tokens", "read\n");
  d.process->signal(SIGHUP);
  EXPECT_TRUE(test::until([&] { return d.process->log().find("tokens.refused") != std::string::npos; }));
  EXPECT_EQ(answer("second-second-second"), StatusCode::OK) << "the tokens before, and the version before, go on";
  EXPECT_EQ(d.process->log().find("second-second"), std::string::npos);
}

/// A direction straight up, `count` times.
std::string up(std::size_t count) {
  std::string planes(12 * count, '\0');
  for (std::size_t i = 2 * count; i < 3 * count; ++i) planes.replace(4 * i, 4, std::string("\0\0\x80\x3f", 4));
  return planes;
}

TEST(Sigterm, HealthFirstThenTheEndAndCallsUnderWayAreAnswered) {
  test::RunningDaemon d;
  d.start({"--listen", d.socket(), "--metrics-listen", "127.0.0.1:0", "--drain-timeout-seconds", "300", "--max-batch-queries", "16777216", "--queue-queries", "20000000"});
  const auto channel = test::fresh_channel(d.addresses[0]);
  EXPECT_EQ(health_of(channel), HealthCheckResponse::SERVING);
  grpc::Status answered(StatusCode::UNKNOWN, "");
  std::thread client([&] {
    test::Context context(std::chrono::minutes(5));
    v1::AlbedoRequest request;
    request.set_material("materials/gold");
    request.set_count(400);  // a second or more
    request.set_wo(up(400));
    v1::AlbedoResponse response;
    answered = v1::BrdfService::NewStub(channel)->Albedo(&context, request, &response);
  });
  const std::string port = d.logged("metrics.listening", "port");
  EXPECT_TRUE(test::until([&] {
    const std::string text = page(port);
    return text.find("\nbrdfd_queue_queries ") != std::string::npos && text.find("\nbrdfd_queue_queries 0\n") == std::string::npos;
  }));
  d.process->signal(SIGTERM);
  EXPECT_TRUE(test::until([&] { return health_of(test::fresh_channel(d.addresses[0])) != HealthCheckResponse::SERVING; }));
  EXPECT_TRUE(test::until([&] { return !test::ask(test::fresh_channel(d.addresses[0])).ok(); })) << "nobody new is let in";
  client.join();
  EXPECT_TRUE(answered.ok()) << answered.error_message();
  EXPECT_EQ(d.process->wait(), 0) << d.process->log();
}

TEST(Sigterm, NewCallsAreTakenDuringTheDelay) {
  test::RunningDaemon d;
  d.start({"--listen", d.socket(), "--drain-delay-seconds", "600"});
  const auto channel = test::fresh_channel(d.addresses[0]);
  test::Context context(std::chrono::minutes(2));
  const auto stub = v1::BrdfService::NewStub(channel);
  const auto stream = stub->EvaluateStream(&context);
  v1::EvaluateStreamRequest request;
  v1::EvaluateRequest& batch = *request.mutable_request();
  batch.set_material("materials/gold");
  batch.set_operations(v1::OPERATION_EVALUATE);
  batch.set_count(1);
  batch.set_wi(up(1));
  batch.set_wo(up(1));
  const auto one_more = [&] {
    v1::EvaluateStreamResponse response;
    return stream->Write(request) && stream->Read(&response) && response.response().values().size() == 12;
  };
  EXPECT_TRUE(one_more());
  EXPECT_EQ(health_of(channel), HealthCheckResponse::SERVING);
  d.process->signal(SIGTERM);
  ASSERT_TRUE(test::until([&] { return health_of(channel) == HealthCheckResponse::NOT_SERVING; }));
  EXPECT_EQ(test::ask(test::fresh_channel(d.addresses[0])).error_code(), StatusCode::OK) << "clients that have not noticed yet";
  EXPECT_TRUE(one_more()) << "and those under way";
  stream->WritesDone();
  EXPECT_TRUE(stream->Finish().ok());
  EXPECT_EQ(test::run_brdfd({"--health-check", d.addresses[0]}).output, "NOT_SERVING\n");
  d.process->signal(SIGHUP);  // is no second SIGTERM
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(d.process->poll(), std::nullopt);
  d.process->signal(SIGTERM);
  EXPECT_EQ(d.process->wait(), 1) << "asked twice: at once";
}

/// What systemd listens to: a name in the file system, or an abstract one behind '@'.
class NotifySocket {
 public:
  explicit NotifySocket(std::string name) : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    if (name.front() == '@') name.front() = '\0';
    name.copy(to.sun_path, sizeof(to.sun_path));
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    if (::bind(fd_, reinterpret_cast<const sockaddr*>(&to), size) != 0) throw std::runtime_error("cannot bind the socket of the notifications");
  }
  ~NotifySocket() { ::close(fd_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// The next message, or nothing where none comes.
  std::string next() const {
    std::array<char, 256> text{};
    ::ssize_t size = -1;
    test::until([&] { return (size = ::recv(fd_, text.data(), text.size(), 0)) >= 0; });
    return {text.data(), static_cast<std::size_t>(std::max<::ssize_t>(size, 0))};
  }

 private:
  int fd_;
};

TEST(Systemd, HearsOfEachState) {
  for (const bool abstract : {false, true}) {
    test::RunningDaemon d;
    const std::string name = (abstract ? "@" : "") + d.place("notify");
    const NotifySocket systemd(name);
    d.start({"--listen", d.socket()}, {"NOTIFY_SOCKET=" + name});
    EXPECT_EQ(systemd.next(), "READY=1");
    EXPECT_TRUE(test::ask(test::fresh_channel(d.socket())).ok()) << "ready means that calls are answered";
    d.process->signal(SIGHUP);
    EXPECT_EQ(systemd.next(), "RELOADING=1");
    EXPECT_EQ(systemd.next(), "READY=1");
    d.process->signal(SIGTERM);
    EXPECT_EQ(systemd.next(), "STOPPING=1");
    EXPECT_EQ(d.process->wait(), 0);
  }
}

TEST(Metrics, TellCallsQueriesAndRefusals) {
  test::RunningDaemon d;
  d.put_secret("tokens", "read 0123456789abcdef\n");
  d.start({"--listen", d.socket(), "--metrics-listen", "127.0.0.1:0", "--tokens", d.place("tokens")});
  const auto channel = test::fresh_channel(d.addresses[0]);
  EXPECT_TRUE(test::ask(channel, "0123456789abcdef").ok());
  for (int i = 0; i < 2; ++i) EXPECT_EQ(test::ask(channel).error_code(), StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(test::ask(channel, "0123456789abcdef", "materials/none").error_code(), StatusCode::NOT_FOUND);
  const std::string text = page(d.logged("metrics.listening", "port"));
  EXPECT_TRUE(says(text, "200 OK"));
  const auto counts = [](const std::string& code) { return "brdfd_calls_total{code=\"" + code + "\",method=\"GetMaterial\"} "; };
  for (const std::string& line : {counts("OK") + "1\n", counts("UNAUTHENTICATED") + "2\n", counts("NOT_FOUND") + "1\n", std::string("brdfd_refused_total{reason=\"token\"} 2\n"),
                                  std::string("brdfd_call_seconds_count{method=\"GetMaterial\"} 4\n"), std::string("brdfd_materials 1\n"), std::string("brdfd_queue_capacity_queries 1000000\n")})
    EXPECT_TRUE(says(text, line));
  EXPECT_EQ(text.find("0123456789abcdef"), std::string::npos);
}

TEST(Program, FlagsBeforeEnvironmentBeforeFileBeforeDefaults) {
  test::RunningDaemon d;
  test::put_text(d.folder / "brdfd.toml", "repository = \"/file\"\nlisten = [\"unix:/file\"]\nworkers = 2\nqueue_queries = 200000\nmax_streams = 7\n");
  const test::Finished printed = test::run_brdfd({"--config", d.place("brdfd.toml"), "--workers", "4", "--listen", "unix:/flag", "--listen", "127.0.0.1:1", "--print-config"},
                                                 {"BRDFD_WORKERS=3", "BRDFD_QUEUE_QUERIES=300000"});
  EXPECT_EQ(printed.code, 0) << printed.log;
  for (const char* line : {"\nworkers = 4\n", "\nqueue_queries = 300000\n", "\nmax_streams = 7\n", "\nmax_batch_queries = 131072\n", "repository = \"/file\"\n",
                           "\nlisten = [\"unix:/flag\", \"127.0.0.1:1\"]\n"})
    EXPECT_TRUE(says(printed.output, line));

  test::put_text(d.folder / "printed.toml", printed.output);
  const test::Finished again = test::run_brdfd({"--config", d.place("printed.toml"), "--print-config"});
  EXPECT_EQ(again.output, printed.output);
  EXPECT_TRUE(says(test::run_brdfd({"--config", d.place("printed.toml"), "--check-config"}).log, "good"));
}

TEST(Program, CheckConfigSaysEverythingThatIsWrong) {
  test::RunningDaemon d;
  d.put_secret("tokens", "read\n");
  const Words good{"--repository", d.place("materials"), "--listen", d.socket()};
  const auto check = [&](const Words& more) {
    Words flags = good;
    flags.insert(flags.end(), more.begin(), more.end());
    flags.push_back("--check-config");
    return test::run_brdfd(flags);
  };
  EXPECT_EQ(check({}).code, 0);
  const test::Finished two = check({"--log-level", "loud", "--workers", "5000"});
  EXPECT_EQ(two.code, 2);
  EXPECT_TRUE(says(two.log, "log_level"));
  EXPECT_TRUE(says(two.log, "workers"));
  EXPECT_TRUE(says(check({"--tokens", d.place("tokens")}).log, "tokens:1"));
  EXPECT_EQ(check({"--tokens", d.place("nowhere")}).code, 1);
  EXPECT_EQ(test::run_brdfd({"--no-such-flag"}).code, 2);
  EXPECT_EQ(test::run_brdfd({"--config", d.place("nowhere.toml"), "--print-config"}).code, 1);
}

TEST(Program, AHealthCheckOfNobodyFails) {
  test::RunningDaemon d;
  const test::Finished asked = test::run_brdfd({"--health-check", d.socket()});
  EXPECT_EQ(asked.code, 1);
  EXPECT_EQ(asked.output, "");
}

}  // namespace
