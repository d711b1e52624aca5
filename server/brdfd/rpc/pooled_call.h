// SPDX-License-Identifier: Apache-2.0
// A unary call that a worker answers.
#pragma once

#include "rpc/call.h"

#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>

namespace brdf::service {

/// What a call is to cost, and what answers it. `answer` runs on a worker, fills the response, and returns false when it
/// stopped because `Call::is_over`; it may throw.
struct PlannedCall {
  std::uint64_t cost = 1;
  std::function<bool(const Call& call)> answer;
  bool brief = false;  ///< takes some microseconds and waits for nothing: less than waking a worker
};

/// Queries that a brief call may cost.
inline constexpr std::uint64_t brief_cost = 64;

/// `plan` runs in the reactor: it only looks at sizes and may throw. Gives what a method of a callback service returns.
grpc::ServerUnaryReactor* start_pooled(Serving& serving, Method method, Role role, grpc::CallbackServerContext* context,
                                       const std::function<PlannedCall()>& plan);

}  // namespace brdf::service
