// SPDX-License-Identifier: Apache-2.0
// Where settings come from, and which are refused.
#include "config/listen_address.h"
#include "config/load_settings.h"
#include "config/log.h"
#include "config/tokens.h"
#include "server/daemon_fixture.h"
#include "support/expect_error.h"

#include <sys/stat.h>

#include <map>

namespace {

using namespace brdf;
using namespace brdf::service;

Environment environment(std::map<std::string, std::string> values) {
  return [values](const std::string& name) -> std::optional<std::string> {
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  };
}

struct TomlFile {
  explicit TomlFile(const std::string& text) { test::put_text(path, text); }
  test::TemporaryFolder folder;
  std::filesystem::path path = folder / "brdfd.toml";
};

Settings good() {
  Settings s;
  s.repository = "/srv/materials";
  s.listen = {"unix:/run/brdfd.sock"};
  return s;
}

bool any_holds(const std::vector<std::string>& sentences, const std::string& word) {
  return std::any_of(sentences.begin(), sentences.end(), [&](const std::string& s) { return s.find(word) != std::string::npos; });
}

TEST(Settings, FlagsBeforeEnvironmentBeforeFileBeforeDefaults) {
  const TomlFile file("workers = 2\nqueue_queries = 200000\nmax_streams = 7\nlisten = [\"unix:/a\", \"127.0.0.1:1\"]\n");
  const Settings s = load_settings(file.path, environment({{"BRDFD_WORKERS", "3"}, {"BRDFD_QUEUE_QUERIES", "300000"}}), {{"workers", "4"}});
  EXPECT_EQ(s.workers, 4U);
  EXPECT_EQ(s.queue_queries, 300000U);
  EXPECT_EQ(s.max_streams, 7U);
  EXPECT_EQ(s.max_batch_queries, Settings{}.max_batch_queries);
  EXPECT_EQ(s.listen, (TextList{"unix:/a", "127.0.0.1:1"}));
}

TEST(Settings, EverySettingIsReadFromEachSourceAndPrinted) {
  for (const Setting& setting : setting_table()) {
    const bool is_switch = std::holds_alternative<bool Settings::*>(setting.field), is_text = std::holds_alternative<std::string Settings::*>(setting.field);
    const bool is_list = std::holds_alternative<TextList Settings::*>(setting.field);
    const std::string text = is_switch ? "true" : is_text || is_list ? "word" : "17";
    const TomlFile file(std::string(setting.name) + " = " + (is_text ? "\"word\"" : is_list ? "[\"word\"]" : text) + "\n");
    const std::string from_flag = print_settings(load_settings({}, environment({}), {{std::string(setting.name), text}}));
    EXPECT_EQ(from_flag, print_settings(load_settings({}, environment({{variable_of(setting), text}}), {}))) << setting.name;
    EXPECT_EQ(from_flag, print_settings(load_settings(file.path, environment({}), {}))) << setting.name;
    EXPECT_TRUE(from_flag != print_settings({}) || (is_switch && print_settings({}).find(std::string(setting.name) + " = true") != std::string::npos)) << setting.name;
  }
}

TEST(Settings, WhatIsPrintedReadsBackTheSame) {
  Settings s = good();
  s.tokens = "a \"quoted\" \\ path\nwith a line";
  s.drain_delay_seconds = 0.1;
  s.listen = {"unix:/a", "[::1]:80"};
  const TomlFile file(print_settings(s));
  EXPECT_EQ(print_settings(load_settings(file.path, environment({}), {})), print_settings(s));
}

TEST(Settings, BadValuesNameWhereTheyStand) {
  const auto load = [](const std::string& text) {
    const TomlFile file(text);
    load_settings(file.path, environment({}), {});
  };
  test::expect_error(ErrorCode::invalid_argument, {"brdfd.toml:2", "worker", "no setting"}, [&] { load("workers = 1\nworker = 2\n"); });
  test::expect_error(ErrorCode::invalid_argument, {"brdfd.toml:1", "workers"}, [&] { load("workers = -1\n"); });
  test::expect_error(ErrorCode::invalid_argument, {"workers", "must not be a text"}, [&] { load("workers = \"2\"\n"); });
  test::expect_error(ErrorCode::invalid_argument, {"brdfd.toml:1"}, [&] { load("workers = \n"); });
  test::expect_error(ErrorCode::invalid_argument, {"BRDFD_WORKERS", "many"}, [&] { load_settings({}, environment({{"BRDFD_WORKERS", "many"}}), {}); });
  test::expect_error(ErrorCode::invalid_argument, {"--drain-delay-seconds", "nan"}, [&] { load_settings({}, environment({}), {{"drain_delay_seconds", "nan"}}); });
}

TEST(Settings, OnlyThisMachineWithoutTls) {
  EXPECT_TRUE(check_settings(good()).empty());
  for (const char* here : {"127.0.0.1:0", "127.9.9.9:1", "[::1]:80", "localhost:80", "unix:relative"}) {
    Settings s = good();
    s.listen = {here};
    EXPECT_TRUE(check_settings(s).empty()) << here;
  }
  for (const char* there : {"0.0.0.0:80", "[::]:80", "10.0.0.1:80", "example.org:80", "128.0.0.1:1"}) {
    Settings s = good();
    s.listen.push_back(there);
    EXPECT_TRUE(any_holds(check_settings(s), "TLS")) << there;
    Settings tls = s;
    tls.tls_certificate = tls.tls_key = "x.pem";
    EXPECT_TRUE(check_settings(tls).empty()) << there;
    s.allow_insecure = true;
    EXPECT_TRUE(check_settings(s).empty()) << there;
  }
  Settings metrics = good();  // the metrics' server has no TLS
  metrics.tls_certificate = metrics.tls_key = "x.pem";
  metrics.metrics_listen = "0.0.0.0:9090";
  EXPECT_TRUE(any_holds(check_settings(metrics), "metrics_listen"));
}

TEST(Settings, ContradictionsAreFound) {
  Settings s = good();
  s.repository_mode = "sometimes";
  s.tls_key = "key.pem";
  s.queue_queries = 10;
  s.listen = {"nowhere"};
  const auto problems = check_settings(s);
  for (const char* word : {"repository_mode", "tls_certificate", "queue_queries", "nowhere"}) EXPECT_TRUE(any_holds(problems, word)) << word;
  EXPECT_TRUE(any_holds(check_settings({}), "repository is not set"));
}

TEST(ListenAddress, BadOnesAreRefused) {
  for (const char* bad : {"", "unix:", ":80", "host", "host:", "host:x", "host:65536", "::1:80", "a:1 "})
    test::expect_error(ErrorCode::invalid_argument, {"is no address"}, [&] { parse_listen_address(bad); });
  test::expect_error(ErrorCode::invalid_argument, {"at most"}, [&] { parse_listen_address("unix:" + std::string(200, 'a')); });
  EXPECT_EQ(parse_listen_address("[::1]:80").text(), "[::1]:80");
}

TEST(Tokens, RolesAndDigests) {
  // The digest is that of 'compress-compress', by sha256sum.
  const Tokens t = Tokens::parse("# who may what\nread 0123456789abcdef\n\n  admin\tfedcba9876543210  \r\ncompress sha256:5c20c910b2c7f152250c40844724b5ecb01ee3ce5bd1237f5273157d9ff9fea1\n", "tokens");
  EXPECT_EQ(t.role_of("0123456789abcdef"), Role::read);
  EXPECT_EQ(t.role_of("fedcba9876543210"), Role::admin);
  EXPECT_EQ(t.role_of("compress-compress"), Role::compress);
  EXPECT_EQ(t.role_of(""), std::nullopt);
  EXPECT_EQ(t.role_of("0123456789abcdeg"), std::nullopt);
  EXPECT_EQ(t.role_of("0123456789abcde"), std::nullopt);
}

TEST(Tokens, MistakesNameTheLineAndNotTheToken) {
  for (const char* bad : {"read\n", "write 0123456789abcdef\n", "read short\n", "read 0123456789abcdef more\n", "read sha256:12\n"}) {
    try {
      Tokens::parse(std::string("# comment\n") + bad, "tokens");
      ADD_FAILURE() << bad;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("tokens:2"), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find("0123456789"), std::string::npos) << e.what();
    }
  }
  const TomlFile file("read 0123456789abcdef\n");
  ::chmod(file.path.c_str(), 0644);
  test::expect_error(ErrorCode::invalid_argument, {"everybody"}, [&] { Tokens::read(file.path); });
  ::chmod(file.path.c_str(), 0600);
  EXPECT_EQ(Tokens::read(file.path).role_of("0123456789abcdef"), Role::read);
}

TEST(Log, FieldsCannotForgeLines) {
  EXPECT_EQ(format_event(true, "e", {{"name", "a\"\n\x1b"}}), "\"e\", \"name\": \"a\\\"\\u000a\\u001b\"");
  EXPECT_EQ(format_event(false, "e", {{"name", "b\n"}}), "e name=\"b\\u000a\"");
}

}  // namespace
