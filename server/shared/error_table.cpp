// SPDX-License-Identifier: Apache-2.0
#include "shared/error_table.h"

#include <algorithm>
#include <array>

namespace brdf::service {
namespace {

using grpc::StatusCode;

constexpr std::array rows{
    ErrorRow{ErrorCode::invalid_argument, StatusCode::INVALID_ARGUMENT, 2},
    ErrorRow{ErrorCode::io, StatusCode::UNAVAILABLE, 1},
    ErrorRow{ErrorCode::not_recognized, StatusCode::INVALID_ARGUMENT, 3},
    ErrorRow{ErrorCode::malformed, StatusCode::INVALID_ARGUMENT, 3},
    ErrorRow{ErrorCode::truncated, StatusCode::INVALID_ARGUMENT, 3},
    ErrorRow{ErrorCode::limit_exceeded, StatusCode::RESOURCE_EXHAUSTED, 3},
    ErrorRow{ErrorCode::unsupported, StatusCode::UNIMPLEMENTED, 3},
    ErrorRow{ErrorCode::checksum, StatusCode::DATA_LOSS, 3},
    ErrorRow{ErrorCode::no_data, StatusCode::INVALID_ARGUMENT, 3},
    ErrorRow{ErrorCode::target_not_met, StatusCode::FAILED_PRECONDITION, 4},
    ErrorRow{ErrorCode::cancelled, StatusCode::CANCELLED, 130},
};

}  // namespace

std::span<const ErrorRow> error_table() noexcept { return rows; }

grpc::StatusCode status_of(ErrorCode code) noexcept {
  const auto row = std::find_if(rows.begin(), rows.end(), [code](const ErrorRow& r) { return r.code == code; });
  return row == rows.end() ? StatusCode::INTERNAL : row->status;
}

int exit_code_of(grpc::StatusCode status) noexcept {
  switch (status) {
    case StatusCode::OK: return 0;
    case StatusCode::INVALID_ARGUMENT: return 2;
    case StatusCode::NOT_FOUND:
    case StatusCode::OUT_OF_RANGE:
    case StatusCode::DATA_LOSS: return 3;
    case StatusCode::FAILED_PRECONDITION: return 4;
    case StatusCode::CANCELLED: return 130;
    default: return 1;  // the service: unreachable, overloaded, too slow, or it does not let the caller in
  }
}

}  // namespace brdf::service
