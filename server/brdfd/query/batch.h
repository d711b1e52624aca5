// SPDX-License-Identifier: Apache-2.0
// One batch of queries: what may be asked, and the answers.
#pragma once

#include "brdf/v1/query.pb.h"

#include <brdf/material.h>

#include <cstdint>
#include <functional>

namespace brdf::service {

struct BatchLimits {
  std::uint64_t max_queries = 131'072;
  std::uint64_t max_message_bytes = std::uint64_t{4} << 20;
};

/// What a valid request asks for.
struct BatchPlan {
  EvalLevel level = EvalLevel::balanced;
  bool evaluate = false, pdf = false, sample = false;
  std::uint64_t cost = 0;  ///< queries times operations

  bool sampling() const noexcept { return pdf || sample; }
};

/// Looks at sizes and choices, not at the numbers: quick. Throws Error(invalid_argument, limit_exceeded) naming the field.
BatchPlan plan_batch(const v1::EvaluateRequest& request, const BatchLimits& limits);

/// Bytes of the answer. Throws Error(limit_exceeded) where a message may not be so large.
std::uint64_t answer_bytes(const BatchPlan& plan, std::uint64_t count, int channels, const BatchLimits& limits);

EvalLevel level_of(v1::EvalLevel level);

/// True when nobody waits for the answer any more. Asked every `stop_interval` queries.
using Stop = std::function<bool()>;
inline constexpr std::size_t stop_interval = 1024;

/// Fills count, channels and the planes of `response`; version and error are the caller's. False when stopped. Throws
/// Error(invalid_argument) for a direction that is neither a unit vector (within 0.001) nor zero, or a random number outside
/// [0, 1), naming field and query. `material` is prepared for sampling where the plan samples.
bool answer_batch(const Material& material, const BatchPlan& plan, const v1::EvaluateRequest& request, v1::EvaluateResponse& response, const Stop& stop);

/// Albedo in the same way. Precondition: `request` passed plan_albedo.
std::uint64_t plan_albedo(const v1::AlbedoRequest& request, const BatchLimits& limits);
bool answer_albedo(const Material& material, const v1::AlbedoRequest& request, v1::AlbedoResponse& response, const Stop& stop);

}  // namespace brdf::service
