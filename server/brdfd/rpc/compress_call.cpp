// SPDX-License-Identifier: Apache-2.0
#include "rpc/compress_call.h"

#include "config/log.h"
#include "query/field_error.h"
#include "rpc/material_message.h"
#include "shared/material_name.h"

#include <grpcpp/alarm.h>

#include <mutex>
#include <optional>

namespace brdf::service {
namespace {

/// Of the calls that upload, wait or run: each has a folder that it may fill.
class Place {
 public:
  explicit Place(std::atomic<std::uint64_t>& taken) : taken_(taken), number_(++taken) {}
  ~Place() { --taken_; }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  std::uint64_t number() const noexcept { return number_; }

 private:
  std::atomic<std::uint64_t>& taken_;
  std::uint64_t number_;
};

class CompressCall : public grpc::ServerBidiReactor<v1::CompressRequest, v1::CompressResponse> {
 public:
  CompressCall(Serving& serving, grpc::CallbackServerContext* context) : call_(serving, Method::compress, context) {
    const std::lock_guard lock(mutex_);
    // An upload that never ends would keep its place for ever.
    alarm_.Set(std::chrono::system_clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(serving.settings.compress_seconds * 1000)), [this](bool rang) { on_alarm(rang); });
    try {
      call_.require(Role::compress);
      if (!serving.compress) throw StatusError(grpc::StatusCode::UNIMPLEMENTED, "COMPRESS_OFF", "this server does not compress");
      place_.emplace(serving.compress_calls);
      if (place_->number() > serving.compressions.capacity()) refuse();
      read();
    } catch (...) {
      end(call_.status_of_exception());
    }
  }

  void OnReadDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    reading_ = false;
    if (outcome_) return;
    try {
      Serving& serving = call_.serving();
      if (ok) {
        // One chunk of each call at a time, so the queue is bounded by the calls; a full one is an overloaded disk.
        if (!serving.uploads.submit(1 + request_.ByteSizeLong(), [this] { store(); })) {
          call_.overloaded("upload", "too many uploads are being stored", std::chrono::seconds(1));
        }
      } else {
        if (call_.is_over()) return end(call_.over());
        if (is_cut_short(request_)) return end(unreadable_message());
        if (!job_) throw FieldError("options", "are missing, they come first");
        say_progress("waiting", 0);
        if (!serving.compressions.submit(1, [this] { compress(); })) refuse();
        uploaded_ = true;
      }
    } catch (...) {
      end(call_.status_of_exception());
    }
  }

  void OnWriteDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    if (!ok && !outcome_) stop_ = true;
    write_next();
  }

  void OnDone() override {
    alarm_.Cancel();
    release();
  }

 private:
  void on_alarm(bool rang) {
    if (rang) {
      const std::lock_guard lock(mutex_);
      late_ = !uploaded_;
      if (late_ && reading_) end_late();  // what is being stored sees it at its end
    }
    release();
  }

  /// The reactor goes when gRPC and the alarm have both let go of it.
  void release() {
    {
      const std::lock_guard lock(mutex_);
      if (--holders_ != 0) return;
    }
    delete this;
  }

  [[noreturn]] void refuse() {
    Serving& s = call_.serving();
    call_.overloaded("compress", std::to_string(s.compress_calls) + " compressions upload, wait or run, this server takes " + std::to_string(s.compressions.capacity()), s.compressions.expected_wait());
  }

  // On the thread of uploads.
  void store() {
    std::exception_ptr failed;
    try {
      if (request_.has_options()) {
        if (job_) throw FieldError("options", "came twice");
        job_.emplace(*call_.serving().compress, request_.options());
        options_ = request_.options();
        check_place();
      } else if (request_.has_chunk()) {
        if (!job_) throw FieldError("options", "are missing, they come first");
        job_->add(request_.chunk());
      } else {
        throw FieldError("part", "is missing: a message holds neither options nor a chunk");
      }
    } catch (...) {
      failed = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    if (failed) return fail(failed);
    if (late_) return end_late();
    request_.Clear();
    read();
  }

  /// Before the upload and not only after the work.
  void check_place() const {
    const std::string id = parse_material_name(options_.name())->id;
    if (!options_.overwrite() && call_.serving().repository.catalogue()->find(id)) {
      throw StatusError(grpc::StatusCode::ALREADY_EXISTS, "MATERIAL_EXISTS", options_.name() + " exists already; overwrite replaces it");
    }
  }

  // On a thread of compressions.
  void compress() {
    std::exception_ptr failed;
    bool ended = false;
    VersionHandle version;
    try {
      const auto stop = [this] { return call_.is_over() || call_.serving().ending || stop_; };
      if (stop()) throw Error(ErrorCode::cancelled, "the compression was cancelled");
      std::vector<std::byte> bytes = job_->run(
          [this](const std::string& stage, double done) {
            const std::lock_guard lock(mutex_);
            say_progress(stage, done);
          },
          stop);
      if (stop()) throw Error(ErrorCode::cancelled, "the compression was cancelled");
      check_place();
      version = call_.serving().repository.publish(parse_material_name(options_.name())->id, std::move(bytes), options_.overwrite());
      log_event(Severity::info, "material.compressed", {{"material", version->id}, {"version", version->version}, {"bytes", std::to_string(version->bytes.size())}});
    } catch (const Error& e) {
      failed = std::current_exception();
      ended = e.code() == ErrorCode::cancelled && call_.serving().ending && !call_.is_over();
    } catch (...) {
      failed = std::current_exception();
    }
    job_.reset();
    const std::lock_guard lock(mutex_);
    if (ended) return end({grpc::StatusCode::UNAVAILABLE, "the server ends"});  // another replica can do it
    if (failed) return fail(failed);
    progress_.reset();
    result_ = version;
    outcome_ = grpc::Status::OK;
    place_.reset();
    write_next();
  }

  // All below with the mutex held.

  void read() {
    reading_ = true;
    StartRead(&request_);
  }

  void end_late() {
    end(detailed_status(grpc::StatusCode::DEADLINE_EXCEEDED, "the upload did not end within " + std::to_string(static_cast<std::int64_t>(call_.serving().settings.compress_seconds)) + " s, the limit of this server",
                        {"UPLOAD_TOO_SLOW", {}, {}}));
  }

  void say_progress(const std::string& stage, double done) {
    progress_.emplace();
    progress_->mutable_progress()->set_stage(stage);
    progress_->mutable_progress()->set_done(done);
    write_next();
  }

  /// A client that reads slowly gets the last progress, not all of it.
  void write_next() {
    if (writing_) return;
    if (progress_) {
      response_ = *progress_;
      progress_.reset();
    } else if (result_) {
      response_.Clear();
      fill(*response_.mutable_material(), *result_);
      result_ = nullptr;
    } else {
      if (outcome_ && !finished_) {
        finished_ = true;
        call_.count(*outcome_);
        Finish(*outcome_);
      }
      return;
    }
    writing_ = true;
    StartWrite(&response_);
  }

  void fail(const std::exception_ptr& failed) {
    try {
      std::rethrow_exception(failed);
    } catch (...) {
      end(call_.status_of_exception());
    }
  }

  void end(const grpc::Status& status) {
    if (outcome_) return;
    outcome_ = status;
    progress_.reset();
    // Now, and not when gRPC or the alarm let go: a client that does not read its answer keeps no place, and the end of the daemon no folder.
    job_.reset();
    place_.reset();
    write_next();
  }

  Call call_;
  std::optional<Place> place_;
  std::mutex mutex_;
  grpc::Alarm alarm_;
  int holders_ = 2;
  v1::CompressRequest request_;
  v1::CompressResponse response_;
  v1::CompressOptions options_;
  std::optional<CompressJob> job_;  ///< touched by one of reactor, upload thread and compression at a time
  std::optional<v1::CompressResponse> progress_;
  VersionHandle result_;
  std::optional<grpc::Status> outcome_;
  bool reading_ = false, uploaded_ = false, late_ = false, writing_ = false, finished_ = false;
  std::atomic<bool> stop_{false};
};

}  // namespace

grpc::ServerBidiReactor<v1::CompressRequest, v1::CompressResponse>* start_compress(Serving& serving, grpc::CallbackServerContext* context) {
  return new CompressCall(serving, context);
}

}  // namespace brdf::service
