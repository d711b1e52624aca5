// SPDX-License-Identifier: Apache-2.0
// For programs whose errors are one sentence, which has gRPC's reason in it.
#pragma once

#include <grpc/support/log.h>

#include <cstdlib>

namespace brdf::service {

/// gRPC prints no lines of its own any more; $GRPC_VERBOSITY brings them back. For the whole process.
inline void silence_grpc() noexcept {
  if (std::getenv("GRPC_VERBOSITY") == nullptr) gpr_set_log_function([](gpr_log_func_args*) {});
}

}  // namespace brdf::service
