// SPDX-License-Identifier: Apache-2.0
#include "client/client_state.h"
#include "shared/content_hash.h"

#include <algorithm>
#include <span>

namespace brdf::client {
namespace {

constexpr int most_attempts = 4;

std::string_view text_of(std::span<const std::byte> bytes) noexcept { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// First half of a SHA-256 as a version has it: what a prefix is called in the cache.
std::string version_of_digest(const std::string& digest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const char c : digest.substr(0, 16)) {
    const auto b = static_cast<unsigned char>(c);
    (text += digits[b >> 4]) += digits[b & 15];
  }
  return text;
}

/// One download, perhaps over several connections.
class Download {
 public:
  Download(const FileCache& cache, const std::string& name, const FetchOptions& options) : cache_(cache) {
    request_.set_name(name);
    if (options.max_bytes) request_.set_max_bytes(*options.max_bytes);
    if (options.max_log_mae) request_.set_max_log_mae(*options.max_log_mae);
  }

  grpc::Status read(v1::BrdfService::Stub& stub, grpc::ClientContext& context) {
    const auto reader = stub.DownloadMaterial(&context, request_);
    v1::DownloadMaterialResponse message;
    while (reader->Read(&message)) {
      if (message.has_header() && !begin(message.header())) return stop(*reader, context);
      const auto chunk = std::as_bytes(std::span(message.chunk()));
      fetched_.bytes.insert(fetched_.bytes.end(), chunk.begin(), chunk.end());
      if (fetched_.bytes.size() > header_.prefix_bytes()) return stop(*reader, context);  // take() says so
      request_.set_offset(fetched_.bytes.size());
    }
    return reader->Finish();
  }

  Fetched take() {
    if (!fetched_.from_cache) {
      const service::Sha256 digest = service::sha256(fetched_.bytes);
      if (fetched_.bytes.size() != header_.prefix_bytes() || text_of(digest) != header_.sha256()) {
        throw CallError(grpc::StatusCode::DATA_LOSS, header_.version() + ": what arrived is not what the server announced");
      }
      cache_.store(version_of_digest(header_.sha256()), fetched_.bytes);
    }
    return std::move(fetched_);
  }

 private:
  /// Enough was read.
  static grpc::Status stop(grpc::ClientReader<v1::DownloadMaterialResponse>& reader, grpc::ClientContext& context) {
    context.TryCancel();
    reader.Finish();
    return grpc::Status::OK;
  }

  /// False when the cache has it.
  bool begin(const v1::DownloadHeader& header) {
    if (!header_.version().empty() && (header.version() != header_.version() || header.sha256() != header_.sha256())) {
      throw CallError(grpc::StatusCode::DATA_LOSS, header_.version() + " changed while it was fetched");
    }
    header_ = header;
    fetched_.version = header.version();
    fetched_.file_bytes = header.file_bytes();
    if (header.has_error()) fetched_.error = header.error();
    if (header.prefix_bytes() > DecodeLimits{}.max_file_bytes) throw CallError(grpc::StatusCode::DATA_LOSS, header.version() + " is larger than any material may be");
    request_.set_name(header.version());  // what is fetched on a second connection is the same version
    if (request_.offset() != 0) return true;
    auto cached = cache_.find(version_of_digest(header.sha256()));
    if (!cached) return true;
    fetched_.bytes = std::move(*cached);
    fetched_.from_cache = true;
    return false;
  }

  const FileCache& cache_;
  v1::DownloadMaterialRequest request_;
  v1::DownloadHeader header_;
  Fetched fetched_;
};

}  // namespace

Fetched Client::fetch(const std::string& name, const FetchOptions& options) {
  const auto parsed = service::parse_material_name(name);
  if (parsed && !parsed->version.empty() && !options.max_bytes && !options.max_log_mae) {
    if (auto bytes = state_->cache.find(parsed->version)) {
      Fetched fetched;
      fetched.version = name;
      fetched.file_bytes = bytes->size();
      fetched.bytes = std::move(*bytes);
      fetched.from_cache = true;
      return fetched;
    }
  }
  const auto channels = state_->replicas.channels_for(parsed ? parsed->id : name);
  Download download(state_->cache, name, options);
  const State::Time until = state_->deadline();
  for (std::size_t attempt = 0;; ++attempt) {
    grpc::ClientContext context;
    state_->prepare(context, until);
    v1::BrdfService::Stub stub(channels[attempt % channels.size()]);
    const grpc::Status status = download.read(stub, context);
    if (status.ok()) return download.take();
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE || attempt + 1 >= std::max<std::size_t>(most_attempts, channels.size())) State::fail(status, context);
  }
}

}  // namespace brdf::client
