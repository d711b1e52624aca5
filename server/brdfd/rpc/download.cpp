// SPDX-License-Identifier: Apache-2.0
#include "rpc/download.h"

#include "query/field_error.h"
#include "rpc/material_message.h"
#include "shared/content_hash.h"
#include "shared/material_name.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace brdf::service {
namespace {

constexpr std::uint64_t chunk_bytes = 65536;

class Download : public grpc::ServerWriteReactor<v1::DownloadMaterialResponse> {
 public:
  Download(Serving& serving, grpc::CallbackServerContext* context, const v1::DownloadMaterialRequest& request)
      : call_(serving, Method::download_material, context) {
    try {
      call_.require(Role::read);
      version_ = find_version(*serving.repository.catalogue(), "name", request.name());
      end_ = download_end(*version_, request);
      at_ = request.offset();
      if (at_ > end_) throw StatusError(grpc::StatusCode::OUT_OF_RANGE, "OFFSET_BEHIND_END", "offset is " + std::to_string(at_) + ", this download ends at byte " + std::to_string(end_));
      // The checksum costs about as much as a query for every hundred bytes.
      if (!serving.workers.submit(1 + end_ / 100, [this] { begin(); })) {
        call_.overloaded("queue", "this server takes " + std::to_string(serving.workers.capacity()) + " queries at once", serving.workers.expected_wait());
      }
    } catch (...) {
      finish(call_.status_of_exception());
    }
  }

  void OnWriteDone(bool ok) override {
    if (!ok || call_.is_over()) return finish(call_.over());
    if (at_ == end_) return finish(grpc::Status::OK);
    message_.Clear();
    write_next();
  }

  void OnDone() override { delete this; }

 private:
  // On a worker, before the first write.
  void begin() {
    if (call_.is_over()) return finish(call_.over());
    try {
      v1::DownloadHeader& header = *message_.mutable_header();
      header.set_version(version_name(version_->id, version_->version));
      header.set_file_bytes(version_->bytes.size());
      header.set_prefix_bytes(end_);
      const Sha256 digest = sha256(std::span(version_->bytes).first(static_cast<std::size_t>(end_)));
      header.set_sha256(digest.data(), digest.size());
      if (const RecordedError* e = version_->error(version_->refinements_in(end_), EvalLevel::balanced)) fill(*header.mutable_error(), *e);
      call_.serving().metrics.count_bytes_downloaded(end_ - at_);
    } catch (...) {
      return finish(call_.status_of_exception());
    }
    write_next();
  }

  void write_next() {
    const std::uint64_t n = std::min(chunk_bytes, end_ - at_);
    message_.set_chunk(version_->bytes.data() + at_, static_cast<std::size_t>(n));
    at_ += n;
    StartWrite(&message_);
  }

  void finish(const grpc::Status& status) {
    call_.count(status);
    Finish(status);
  }

  Call call_;
  VersionHandle version_;
  std::uint64_t at_ = 0, end_ = 0;
  v1::DownloadMaterialResponse message_;
};

}  // namespace

std::uint64_t download_end(const MaterialVersion& version, const v1::DownloadMaterialRequest& request) {
  const auto& ends = version.boundaries;
  if (request.has_max_bytes()) {
    if (version.bytes.size() <= request.max_bytes()) return version.bytes.size();
    for (std::size_t i = ends.size(); i-- > 0;)
      if (ends[i] <= request.max_bytes()) return ends[i];
    throw FieldError("max_bytes", "is " + std::to_string(request.max_bytes()) + ", the smallest prefix of " + version.id + " has " + std::to_string(ends.front()));
  }
  if (request.has_max_log_mae()) {
    if (!(request.max_log_mae() >= 0) || !std::isfinite(request.max_log_mae())) throw FieldError("max_log_mae", "must be a number of at least 0");
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const RecordedError* e = version.error(static_cast<int>(i), EvalLevel::balanced);
      if (e != nullptr && e->log_mae <= request.max_log_mae()) return ends[i];
    }
  }
  return version.bytes.size();
}

grpc::ServerWriteReactor<v1::DownloadMaterialResponse>* start_download(Serving& serving, grpc::CallbackServerContext* context, const v1::DownloadMaterialRequest* request) {
  return new Download(serving, context, *request);
}

}  // namespace brdf::service
