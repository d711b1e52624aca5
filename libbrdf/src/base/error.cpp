// SPDX-License-Identifier: Apache-2.0
#include <brdf/error.h>

namespace brdf {

// No default branch: the compiler then names a code that was added and not listed here.
const char* to_string(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::invalid_argument: return "invalid_argument";
    case ErrorCode::io: return "io";
    case ErrorCode::not_recognized: return "not_recognized";
    case ErrorCode::malformed: return "malformed";
    case ErrorCode::truncated: return "truncated";
    case ErrorCode::limit_exceeded: return "limit_exceeded";
    case ErrorCode::unsupported: return "unsupported";
    case ErrorCode::checksum: return "checksum";
    case ErrorCode::no_data: return "no_data";
    case ErrorCode::target_not_met: return "target_not_met";
    case ErrorCode::cancelled: return "cancelled";
  }
  return "unknown";
}

}  // namespace brdf
