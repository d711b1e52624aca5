// SPDX-License-Identifier: Apache-2.0
// TLS and mutual TLS of the running daemon: who is let in, who is not, and certificates that change while it serves.
#include "server/certificates.h"
#include "server/running_daemon.h"

namespace {

using namespace brdf;
using grpc::StatusCode;
using test::Authority;
using test::Identity;
using test::Words;
using test::says;

std::shared_ptr<grpc::ChannelCredentials> trusting(const Authority& authority, const Identity& self = {}) { return grpc::SslCredentials({authority.certificate(), self.key, self.certificate}); }

struct TlsDaemon : test::RunningDaemon {
  void write(const Identity& identity) const {
    put_secret("key.pem", identity.key);
    put_secret("certificate.pem", identity.certificate);
  }

  Words flags() const { return {"--listen", "127.0.0.1:0", "--tls-certificate", place("certificate.pem"), "--tls-key", place("key.pem"), "--tls-reload-seconds", "1"}; }

  void serve(const Identity& identity, const Words& more = {}) {
    write(identity);
    Words all = flags();
    all.insert(all.end(), more.begin(), more.end());
    start(all);
  }

  StatusCode answer(const std::shared_ptr<grpc::ChannelCredentials>& credentials) const { return test::ask(test::fresh_channel(addresses.at(0), credentials)).error_code(); }
};

TEST(Tls, WhoTrustsTheAuthorityIsServedAndPlainTextIsNot) {
  const Authority ours("ours"), others("others");
  TlsDaemon d;
  d.serve(ours.issue("server"));
  EXPECT_EQ(d.answer(trusting(ours)), StatusCode::OK);
  EXPECT_EQ(d.answer(trusting(others)), StatusCode::UNAVAILABLE);
  EXPECT_EQ(d.answer(grpc::InsecureChannelCredentials()), StatusCode::UNAVAILABLE);

  d.put_secret("ca.pem", ours.certificate());
  d.put_secret("other.pem", others.certificate());
  const test::Finished checked = test::run_brdfd({"--health-check", d.addresses[0], "--health-check-ca", d.place("ca.pem")});
  EXPECT_EQ(checked.code, 0) << checked.log;
  EXPECT_EQ(checked.output, "SERVING\n");
  const test::Finished distrusted = test::run_brdfd({"--health-check", d.addresses[0], "--health-check-ca", d.place("other.pem")});
  EXPECT_EQ(distrusted.code, 1);
  EXPECT_TRUE(says(distrusted.log, "certificate verify failed"));
  EXPECT_EQ(std::count(distrusted.log.begin(), distrusted.log.end(), '\n'), 1) << distrusted.log;
  EXPECT_EQ(test::run_brdfd({"--health-check", d.addresses[0]}).code, 1);

  client::ClientOptions options;
  options.servers = d.addresses;
  options.ca_file = d.place("ca.pem");
  EXPECT_EQ(client::Client(options).get("materials/gold").name(), "materials/gold");
}

TEST(Tls, FailedHandshakesAreLoggedAsEverythingElse) {
  const Authority ours("ours");
  TlsDaemon d;
  d.serve(ours.issue("server"), {"--log-format", "json", "--log-level", "debug"});
  EXPECT_EQ(d.answer(grpc::InsecureChannelCredentials()), StatusCode::UNAVAILABLE);
  EXPECT_TRUE(test::until([&] { return d.process->log().find("\"event\": \"grpc\"") != std::string::npos; })) << d.process->log();
  d.process->signal(SIGTERM);
  EXPECT_EQ(d.process->wait(), 0);
  std::istringstream lines(d.process->log());
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(line.starts_with("{\"time\": ") && line.ends_with('}')) << line;
}

TEST(Tls, ClientsRefuseAnExpiredServer) {
  const Authority ours("ours");
  TlsDaemon d;
  d.serve(ours.issue("server", test::expired));
  EXPECT_EQ(d.answer(trusting(ours)), StatusCode::UNAVAILABLE);
}

TEST(MutualTls, OnlyCertificatesOfTheAuthorityThatAreValidNow) {
  const Authority servers("servers"), clients("clients"), others("others");
  TlsDaemon d;
  d.put_secret("clients.pem", clients.certificate());
  d.serve(servers.issue("server"), {"--tls-client-ca", d.place("clients.pem")});
  const Identity good = clients.issue("renderer");
  EXPECT_EQ(d.answer(trusting(servers, good)), StatusCode::OK);
  EXPECT_EQ(d.answer(trusting(servers)), StatusCode::UNAVAILABLE) << "no certificate";
  EXPECT_EQ(d.answer(trusting(servers, others.issue("renderer"))), StatusCode::UNAVAILABLE) << "of another authority";
  EXPECT_EQ(d.answer(trusting(servers, clients.issue("renderer", test::expired))), StatusCode::UNAVAILABLE) << "expired";
  EXPECT_EQ(d.answer(trusting(servers, clients.issue("renderer", {1800, 3600}))), StatusCode::UNAVAILABLE) << "not yet valid";
  EXPECT_EQ(d.answer(grpc::InsecureChannelCredentials()), StatusCode::UNAVAILABLE);

  d.put_secret("ca.pem", servers.certificate());
  d.put_secret("self.pem", good.certificate);
  d.put_secret("self.key", good.key);
  const Words check{"--health-check", d.addresses[0], "--health-check-ca", d.place("ca.pem")};
  EXPECT_EQ(test::run_brdfd(check).code, 1);
  Words with = check;
  with.insert(with.end(), {"--health-check-certificate", d.place("self.pem"), "--health-check-key", d.place("self.key")});
  EXPECT_EQ(test::run_brdfd(with).output, "SERVING\n");
  client::ClientOptions options;
  options.servers = d.addresses;
  options.ca_file = d.place("ca.pem");
  options.certificate_file = d.place("self.pem");
  options.key_file = d.place("self.key");
  EXPECT_EQ(client::Client(options).get("materials/gold").name(), "materials/gold");
}

TEST(Tls, ChangedCertificatesAreReadAgain) {
  const Authority before("before"), after("after");
  TlsDaemon d;
  d.serve(before.issue("server"));
  const auto held = test::fresh_channel(d.addresses[0], trusting(before));
  ASSERT_TRUE(test::ask(held).ok());

  test::put_text(d.folder / "certificate.pem", "-----BEGIN CERTIFICATE-----\nnonsense\n-----END CERTIFICATE-----\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // two looks
  EXPECT_TRUE(test::ask(held).ok()) << "a connection goes on";
  EXPECT_EQ(d.process->poll(), std::nullopt);

  d.write(after.issue("server"));
  EXPECT_TRUE(test::until([&] { return d.answer(trusting(after)) == StatusCode::OK; })) << d.process->log();
  EXPECT_EQ(d.answer(trusting(before)), StatusCode::UNAVAILABLE);
  EXPECT_TRUE(test::ask(held).ok()) << "a connection goes on";
}

TEST(Tls, BadFilesAreRefusedAtTheStart) {
  const Authority ours("ours");
  const Identity one = ours.issue("server"), two = ours.issue("server");
  TlsDaemon d;
  const auto refused = [&](const Identity& identity, const Words& more = {}) {
    d.write(identity);
    Words flags{"--repository", d.place("materials")};
    for (const Words& part : {d.flags(), more}) flags.insert(flags.end(), part.begin(), part.end());
    const test::Finished served = test::run_brdfd(flags);
    EXPECT_EQ(served.code, 1) << served.log;
    flags.push_back("--check-config");
    EXPECT_EQ(test::run_brdfd(flags).log, served.log) << "the check sees what the start would";
    return served.log;
  };
  EXPECT_TRUE(says(refused({"nonsense", one.key}), "certificate.pem"));
  EXPECT_TRUE(says(refused({one.certificate, "nonsense"}), "key.pem"));
  EXPECT_TRUE(says(refused({one.certificate, two.key}), "does not belong"));
  EXPECT_TRUE(says(refused(one, {"--tls-client-ca", d.place("key.pem")}), "no certificate"));
  EXPECT_TRUE(says(refused(one, {"--tls-client-ca", d.place("nowhere.pem")}), "nowhere.pem"));
}

TEST(Tls, BeyondThisMachineOnlyWithItUnlessSaidSo) {
  test::RunningDaemon d;
  const Words everywhere{"--repository", d.place("materials"), "--listen", "0.0.0.0:0"};
  const test::Finished refused = test::run_brdfd(everywhere);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(says(refused.log, "TLS"));
  EXPECT_TRUE(says(test::run_brdfd({"--repository", d.place("materials"), "--listen", d.socket(), "--admin-listen", "[::]:0"}).log, "admin_listen"));
  d.start({"--listen", "0.0.0.0:0", "--allow-insecure"});
  const std::string port = d.addresses[0].substr(d.addresses[0].rfind(':'));
  EXPECT_EQ(test::ask(test::fresh_channel("127.0.0.1" + port)).error_code(), StatusCode::OK);
}

}  // namespace
