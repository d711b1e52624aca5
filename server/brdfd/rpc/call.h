// SPDX-License-Identifier: Apache-2.0
// What every call has: a role that it needs, a status that the exception of its work becomes, figures.
#pragma once

#include "rpc/error_details.h"
#include "rpc/serving.h"

#include <google/protobuf/message_lite.h>
#include <grpcpp/server_context.h>

#include <chrono>
#include <exception>
#include <stdexcept>

namespace brdf::service {

/// Ends a call with a status that no error of the library stands for.
class StatusError : public std::runtime_error {
 public:
  StatusError(grpc::StatusCode code, ErrorDetails details, const std::string& sentence) : std::runtime_error(sentence), code_(code), details_(std::move(details)) {}
  StatusError(grpc::StatusCode code, const char* reason, const std::string& sentence) : StatusError(code, ErrorDetails{reason, {}, {}}, sentence) {}
  grpc::StatusCode code() const noexcept { return code_; }
  const ErrorDetails& details() const noexcept { return details_; }

 private:
  grpc::StatusCode code_;
  ErrorDetails details_;
};

class Call {
 public:
  Call(Serving& serving, Method method, grpc::CallbackServerContext* context)
      : serving_(serving), context_(context), method_(method), start_(std::chrono::steady_clock::now()) {}

  Serving& serving() const noexcept { return serving_; }

  /// Throws StatusError(UNAUTHENTICATED, PERMISSION_DENIED).
  void require(Role role) const;
  /// Throws StatusError(RESOURCE_EXHAUSTED) after telling the client when to come back.
  [[noreturn]] void overloaded(const char* reason, const std::string& sentence, std::chrono::milliseconds retry) const;

  /// Nobody waits any more: cancelled, or the deadline is over.
  bool is_over() const;
  grpc::Status over() const;
  /// The status of the exception that is being handled, with details, and the library's code in the trailing metadata. To be
  /// called before Finish.
  grpc::Status status_of_exception() const;

  /// Counts the call; once.
  void count(const grpc::Status& status) const;

 private:
  Serving& serving_;
  grpc::CallbackServerContext* context_;
  Method method_;
  std::chrono::steady_clock::time_point start_;
};

/// gRPC says the same of the end of a client's messages and of one that cannot be read. Of the latter something is left in `message`,
/// which was empty before, unless its first byte was wrong already.
bool is_cut_short(const google::protobuf::MessageLite& message);
grpc::Status unreadable_message();

/// The version that a resource name means now. Throws FieldError for `field`, StatusError(NOT_FOUND).
VersionHandle find_version(const Catalogue& catalogue, const char* field, const std::string& name);

}  // namespace brdf::service
