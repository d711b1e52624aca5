// SPDX-License-Identifier: Apache-2.0
#include "run/command.h"

#include "config/load_settings.h"
#include "config/log.h"
#include "run/credentials.h"
#include "run/daemon.h"
#include "run/foreign_logs.h"
#include "run/health_check.h"
#include "run/notify_systemd.h"

#include <brdf/version.h>

#include <CLI/CLI.hpp>

#include <pthread.h>
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <list>

namespace brdf::service {
namespace {

struct Options {
  std::string config;
  HealthQuestion health;
  bool check = false, print = false;
  std::list<std::pair<const Setting*, std::string>> texts;  // CLI11 keeps references
  Flags flags;
};

void add_settings(CLI::App& app, Options& o) {
  for (const Setting& s : setting_table()) {
    std::string& text = o.texts.emplace_back(&s, "").second;
    CLI::Option* option = std::holds_alternative<bool Settings::*>(s.field) ? app.add_flag(flag_of(s), text, std::string(s.help))
                                                                             : app.add_option(flag_of(s), text, std::string(s.help));
    option->group("Settings");
    option->each([&o, &s](const std::string& value) {
      std::string& given = o.flags[std::string(s.name)];
      if (std::holds_alternative<TextList Settings::*>(s.field) && !given.empty()) given += ',';
      std::holds_alternative<TextList Settings::*>(s.field) ? given += value : given = value;
    });
    option->take_last();  // of `text`, which nobody reads; flags has what each occurrence adds
  }
}

std::optional<std::string> environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

/// Before any thread starts, so that all of them leave the signals to wait_for_end.
sigset_t block_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int number : {SIGTERM, SIGINT, SIGHUP}) ::sigaddset(&set, number);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGCHLD, SIG_DFL);  // a parent's SIG_IGN is inherited, and children would vanish
  return set;
}

void wait_for_end(const sigset_t& signals, Daemon& daemon) {
  for (;;) {
    int number = 0;
    if (::sigwait(&signals, &number) != 0) continue;
    if (number != SIGHUP) return;
    log_event(Severity::info, "reload");
    notify_systemd("RELOADING=1");
    daemon.reload();
    notify_systemd("READY=1");
  }
}

int serve(const Settings& settings) {
  const sigset_t signals = block_signals();
  start_log(settings.log_level, settings.log_format);
  route_foreign_logs();
  Daemon daemon(settings);
  std::string line = "brdfd " + std::string(version()) + " ready:";
  for (const std::string& address : daemon.addresses()) line += " " + address;
  line += " (" + std::to_string(daemon.materials()) + " materials)";
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
  notify_systemd("READY=1");
  wait_for_end(signals, daemon);
  notify_systemd("STOPPING=1");
  std::atomic<bool> hurry{false};
  std::thread second([&] {
    int number = 0;
    while (!hurry && (::sigwait(&signals, &number) != 0 || number == SIGHUP)) {
    }
    if (!hurry.exchange(true)) std::_Exit(1);  // asked twice to end: now
  });
  daemon.drain(hurry);
  hurry = true;
  ::pthread_kill(second.native_handle(), SIGTERM);
  second.join();
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app{"Serves compressed materials over gRPC.", "brdfd"};
  Options o;
  app.set_version_flag("--version", "brdfd " + std::string(version()));
  app.add_option("--config", o.config, "TOML file of settings");
  app.add_flag("--check-config", o.check, "Say whether the settings are good, and end");
  app.add_flag("--print-config", o.print, "Print the settings as they are together, and end");
  auto* health = app.add_option("--health-check", o.health.address, "Ask the daemon at this address, and end")->type_name("ADDR");
  auto* ca = app.add_option("--health-check-ca", o.health.ca, "PEM roots for --health-check with TLS")->type_name("FILE")->needs(health);
  auto* certificate = app.add_option("--health-check-certificate", o.health.certificate, "PEM certificate to show with mutual TLS")->type_name("FILE")->needs(ca);
  auto* key = app.add_option("--health-check-key", o.health.key, "PEM key of --health-check-certificate")->type_name("FILE")->needs(certificate);
  certificate->needs(key);
  add_settings(app, o);
  app.footer(
      "Flags come before variables BRDFD_NAME, these before the TOML file, and it before the defaults. SIGHUP looks at the\n"
      "repository now and reads the tokens again; SIGTERM drains, a second one ends at once.\n\n"
      "Example: brdfd --repository materials --listen unix:/run/brdfd.sock");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    std::fprintf(stderr, "brdfd: %s; see brdfd --help\n", e.what());
    return 2;
  }
  if (!o.health.address.empty()) return check_health(o.health, std::chrono::seconds(5));
  const Settings settings = load_settings(o.config, environment, o.flags);
  if (o.print) std::fputs(print_settings(settings).c_str(), stdout);
  const std::vector<std::string> problems = check_settings(settings);
  for (const std::string& problem : problems) std::fprintf(stderr, "brdfd: %s\n", problem.c_str());
  if (!problems.empty()) return 2;
  if (!o.print || o.check) {
    if (!settings.tokens.empty()) (void)Tokens::read(settings.tokens);
    check_tls_files(settings);
  }
  if (o.check) std::fprintf(stderr, "brdfd: the settings are good\n");
  return o.check || o.print ? 0 : serve(settings);
}

}  // namespace

int run_command(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& e) {
    std::fprintf(stderr, "brdfd: %s\n", e.what());
    return e.code() == ErrorCode::invalid_argument ? 2 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "brdfd: %s\n", e.what());
    return 1;
  }
}

}  // namespace brdf::service
