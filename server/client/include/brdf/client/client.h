// SPDX-License-Identifier: Apache-2.0
/// @file client.h
/// The client of brdfd: fetch a material once and evaluate it here, or send batches there.
#pragma once

#include <brdf/material.h>
#include <brdf/v1/brdf_service.pb.h>

#include <grpcpp/support/status.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace brdf::client {

/// A call that failed, after the retries that its status allows.
class CallError : public std::runtime_error {
 public:
  CallError(grpc::StatusCode code, const std::string& sentence, std::string library_code = {})
      : std::runtime_error(sentence), code_(code), library_code_(std::move(library_code)) {}
  grpc::StatusCode code() const noexcept { return code_; }
  /// to_string(ErrorCode) of what the library threw in the server; empty for other reasons.
  const std::string& library_code() const noexcept { return library_code_; }

 private:
  grpc::StatusCode code_;
  std::string library_code_;
};

struct ClientOptions {
  /// Replicas: unix:PATH or HOST:PORT; several are all sockets or all numeric addresses of one kind.
  std::vector<std::string> servers;
  /// Of every call but compress.
  std::chrono::milliseconds deadline{10'000};
  /// Each material goes to a replica of its own (rendezvous hashing), and to the next where that fails, so that each needs
  /// to hold only its share. Otherwise round robin over those that are healthy.
  bool by_material = false;
  std::string token;                                  ///< sent as a bearer token
  std::string ca_file, certificate_file, key_file;    ///< PEM; TLS where ca_file is set, mutual with the other two
  std::filesystem::path cache;                        ///< folder of fetched files by content; empty: none
  std::uint64_t cache_bytes = std::uint64_t{1} << 28; ///< the oldest files go beyond this
};

struct FetchOptions {
  std::optional<std::uint64_t> max_bytes;  ///< the longest prefix of at most this many bytes
  std::optional<double> max_log_mae;       ///< the shortest prefix that is at least this good
};

struct Fetched {
  std::string version;  ///< materials/{material}/versions/{version}
  std::vector<std::byte> bytes;
  std::uint64_t file_bytes = 0;  ///< of the whole file; more than bytes.size() for a prefix
  std::optional<v1::RecordedError> error;
  bool from_cache = false;
};

/// Thread-safe. Every call has a deadline and throws CallError; what reads files, Error, too.
class Client {
 public:
  /// Connects when the first call is made. Throws Error: invalid_argument, io (TLS files).
  explicit Client(ClientOptions options);
  ~Client();
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;

  v1::ListMaterialsResponse list(const v1::ListMaterialsRequest& request);
  v1::Material get(const std::string& name);

  /// Bytes of a material, checked against the server's checksum; resumed where the connection breaks. A version that the
  /// cache holds whole costs no call.
  Fetched fetch(const std::string& name, const FetchOptions& options = {});
  /// fetch and Material::decode: from then on evaluation is a function call.
  Material open(const std::string& name, DecodeOptions decode = {}, const FetchOptions& options = {});

  v1::EvaluateResponse evaluate(const v1::EvaluateRequest& request);
  v1::AlbedoResponse albedo(const v1::AlbedoRequest& request);
  v1::FindSimilarResponse similar(const v1::FindSimilarRequest& request);

  /// Answers in order, several batches under way at once. `next` is called from a thread of its own, which no deadline interrupts, and
  /// gives false at the end; `answer` takes each answer with the number of its request from 0. The deadline counts for the whole stream.
  /// Where a replica ends or refuses, what is not yet answered is asked of another; up to eight batches are kept for that.
  void evaluate_stream(const std::function<bool(v1::EvaluateRequest&)>& next, const std::function<void(std::uint64_t, const v1::EvaluateResponse&)>& answer,
                       std::chrono::milliseconds deadline);

  /// Uploads a measured file. `progress` may return false to cancel. Repeated where the server refused it before the work began, and
  /// where a result may be replaced (`overwrite`), afterwards, too.
  v1::Material compress(const v1::CompressOptions& options, std::span<const std::byte> file, const std::function<bool(const std::string& stage, double done)>& progress,
                        std::chrono::milliseconds deadline);

  /// Whether the service says SERVING.
  bool healthy();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace brdf::client
