// SPDX-License-Identifier: Apache-2.0
#include "run/daemon.h"

#include "config/log.h"
#include "run/server_options.h"

#include <grpcpp/ext/channelz_service_plugin.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <prometheus/exposer.h>

#include <algorithm>

namespace brdf::service {
namespace {

std::chrono::milliseconds milliseconds(double seconds) { return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000)); }

}  // namespace

Daemon::Daemon(const Settings& settings)
    : serving_(settings), brdf_(serving_, watchers_, streams_), admin_(serving_), health_({v1::BrdfService::service_full_name()}), admin_health_({v1::AdminService::service_full_name()}),
      stream_guard_(serving_.metrics, settings.max_streams) {
  read_tokens();
  if (serving_.settings.compress && !serving_.compress) log_event(Severity::warning, "compress.off", {{"reason", "there is no brdf-compress beside brdfd or in PATH"}});
  serving_.repository.on_change([this](const CatalogueHandle&, const CatalogueHandle&) { watchers_.poke(); });
  if (serving_.repository.mode() != RepositoryMode::manual) {
    for (const Refusal& r : poll_repository(serving_).refused) log_event(Severity::warning, "repository.refused", {{"material", r.id}, {"reason", r.reason}});
  }
  try {
    listen();
    listen_for_admin();
    expose_metrics();
    health_.set_serving(true);
    admin_health_.set_serving(true);
    if (serving_.repository.mode() == RepositoryMode::poll) poller_ = std::thread([this] { poll_regularly(); });
  } catch (...) {
    stop();  // somebody may watch already, whom a server waits for
    throw;
  }
}

Daemon::~Daemon() { stop(); }

void Daemon::stop() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  if (poller_.joinable()) poller_.join();
  serving_.ending = true;
  if (!drained_) {
    health_.end();
    admin_health_.end();
    watchers_.poke();
    streams_.end();
  }
  const auto now = std::chrono::system_clock::now();
  if (server_) server_->Shutdown(now);
  if (admin_server_) admin_server_->Shutdown(now);
}

void Daemon::read_tokens() {
  const std::string& file = serving_.settings.tokens;
  if (!file.empty()) serving_.access.set(std::make_shared<const Tokens>(Tokens::read(file)));
}

void Daemon::listen() {
  // For static libraries, where nothing else calls for it; set_server_options decides which server has it.
  if (serving_.settings.reflection) grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  set_server_options(builder, serving_.settings);
  stream_guard_.watch(builder);
  builder.RegisterService(&brdf_);
  builder.RegisterService(&health_);
  server_ = start_listening(builder, serving_.settings.listen, serving_.settings, addresses_);
}

void Daemon::listen_for_admin() {
  const Settings& s = serving_.settings;
  if (s.admin_listen.empty()) return;
  if (s.channelz) grpc::channelz::experimental::InitChannelzService();
  grpc::ServerBuilder builder;
  set_server_options(builder, s);
  builder.RegisterService(&admin_);
  builder.RegisterService(&admin_health_);
  std::vector<std::string> addresses;
  admin_server_ = start_listening(builder, {s.admin_listen}, s, addresses);
  log_event(Severity::info, "admin.listening", {{"address", addresses.front()}});
}

void Daemon::expose_metrics() {
  const std::string& address = serving_.settings.metrics_listen;
  if (address.empty()) return;
  try {
    exposer_ = std::make_unique<prometheus::Exposer>(address, 1);
  } catch (const std::exception& e) {
    throw Error(ErrorCode::io, address + ": cannot serve metrics: " + e.what());
  }
  exposer_->RegisterCollectable(serving_.metrics.collectable());
  for (const int port : exposer_->GetListeningPorts()) log_event(Severity::info, "metrics.listening", {{"port", std::to_string(port)}});
}

void Daemon::reload() noexcept {
  try {
    read_tokens();
  } catch (const std::exception& e) {
    log_event(Severity::error, "tokens.refused", {{"reason", e.what()}});
  }
  try {
    poll_repository(serving_);
  } catch (const std::exception& e) {
    log_event(Severity::error, "repository.unreadable", {{"reason", e.what()}});
  }
}

void Daemon::poll_regularly() {
  const auto interval = milliseconds(serving_.settings.poll_interval_seconds);
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, interval, [this] { return ending_; })) {
    lock.unlock();
    try {
      poll_repository(serving_);
    } catch (const std::exception& e) {
      log_event(Severity::error, "repository.unreadable", {{"reason", e.what()}});
    }
    lock.lock();
  }
}

void Daemon::drain(const std::atomic<bool>& hurry) {
  const Settings& s = serving_.settings;
  log_event(Severity::info, "drain.begins", {{"delay_seconds", std::to_string(s.drain_delay_seconds)}, {"timeout_seconds", std::to_string(s.drain_timeout_seconds)}});
  health_.set_serving(false);
  admin_health_.set_serving(false);
  const auto until = std::chrono::steady_clock::now() + milliseconds(s.drain_delay_seconds);
  while (!hurry && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  serving_.ending = true;  // ends watches, streams, and compressions, which no deadline is long enough for
  health_.end();
  admin_health_.end();
  watchers_.poke();
  streams_.end();
  const auto deadline = std::chrono::system_clock::now() + (hurry ? std::chrono::milliseconds(0) : milliseconds(s.drain_timeout_seconds));
  if (server_) server_->Shutdown(deadline);
  if (admin_server_) admin_server_->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(1));
  drained_ = true;
  log_event(Severity::info, "drain.ended");
}

}  // namespace brdf::service
