// SPDX-License-Identifier: Apache-2.0
// What a program reads of a failed call, beside the sentence for people: the details of google.rpc.Status, as
// https://google.aip.dev/193 has them, in the trailing metadata grpc-status-details-bin.
#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <optional>
#include <string>

namespace brdf::service {

inline constexpr char error_domain[] = "brdf.v1";

struct ErrorDetails {
  std::string reason;  ///< ErrorInfo: UPPER_SNAKE_CASE, one of error_domain
  std::string field;   ///< BadRequest: the field that has no meaning; empty: none
  std::optional<std::chrono::milliseconds> retry;  ///< RetryInfo: when to come back
};

/// A sentence that is too long for the metadata of an answer is cut.
grpc::Status detailed_status(grpc::StatusCode code, const std::string& sentence, const ErrorDetails& details);

}  // namespace brdf::service
