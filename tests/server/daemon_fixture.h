// SPDX-License-Identifier: Apache-2.0
// A repository in a folder of its own, and a daemon on a unix socket in it.
#pragma once

#include "run/daemon.h"
#include "support/golden_bytes.h"
#include "support/temporary_folder.h"

#include <brdf/client/client.h>

#include <grpcpp/create_channel.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

namespace brdf::test {

inline const std::vector<std::byte>& golden(const std::string& name) {
  for (const GoldenFile& f : golden_files())
    if (f.name == name) return f.bytes;
  throw std::runtime_error("no golden file " + name);
}

/// In place of the file, which gets another inode.
inline void put_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::filesystem::path fresh = path.string() + ".new";
  std::ofstream(fresh, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::filesystem::rename(fresh, path);
}

inline void put_text(const std::filesystem::path& path, const std::string& text) { put_file(path, std::as_bytes(std::span(text))); }

struct Served {
  Served() {
    std::filesystem::create_directory(folder / "materials");
    settings.repository = (folder / "materials").string();
    settings.listen = {"unix:" + (folder / "socket").string()};
    settings.poll_interval_seconds = 3600;  // tests say when
    settings.drain_delay_seconds = 0;
    settings.workers = 2;
  }

  void put(const std::string& id, const std::vector<std::byte>& bytes) { put_file(folder / ("materials/" + id + ".brdfc").c_str(), bytes); }

  service::Daemon& start() {
    daemon.emplace(settings);
    channel = grpc::CreateChannel(settings.listen.front(), grpc::InsecureChannelCredentials());
    stub = v1::BrdfService::NewStub(channel);
    return *daemon;
  }

  client::ClientOptions client_options() const {
    client::ClientOptions o;
    o.servers = settings.listen;
    return o;
  }

  TemporaryFolder folder;
  service::Settings settings;
  std::optional<service::Daemon> daemon;
  std::shared_ptr<grpc::Channel> channel;
  std::unique_ptr<v1::BrdfService::Stub> stub;
};

/// A context with a deadline, which every call has.
struct Context : grpc::ClientContext {
  explicit Context(std::chrono::milliseconds deadline = std::chrono::seconds(60)) { set_deadline(std::chrono::system_clock::now() + deadline); }
};

}  // namespace brdf::test
