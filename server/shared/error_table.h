// SPDX-License-Identifier: Apache-2.0
// The one table from the library's errors to statuses of calls and to exit codes of programs; docs/server.md prints it.
#pragma once

#include <brdf/error.h>
#include <grpcpp/support/status.h>

#include <span>

namespace brdf::service {

struct ErrorRow {
  ErrorCode code;
  grpc::StatusCode status;
  int exit_code;  ///< of brdf-query; those of brdf-compress
};

std::span<const ErrorRow> error_table() noexcept;

grpc::StatusCode status_of(ErrorCode code) noexcept;

/// Exit code of brdf-query for a call that ended so.
int exit_code_of(grpc::StatusCode status) noexcept;

/// Trailing metadata with to_string(ErrorCode) of what the library threw.
inline constexpr char error_metadata_key[] = "brdf-error";

}  // namespace brdf::service
