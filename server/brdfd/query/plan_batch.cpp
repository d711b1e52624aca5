// SPDX-License-Identifier: Apache-2.0
#include "query/batch.h"

#include "query/field_error.h"

#include <brdf/error.h>

#include <string>

namespace brdf::service {
namespace {

constexpr std::uint64_t vector_bytes = 3 * sizeof(float);
constexpr std::uint64_t albedo_cost = 9216;  // samples of one quadrature

void require_bytes(const char* field, const std::string& value, std::uint64_t wanted) {
  if (value.size() != wanted) throw FieldError(field, "has " + std::to_string(value.size()) + " bytes, wanted are " + std::to_string(wanted));
}

void require_count(std::uint64_t count, std::uint64_t most) {
  if (count == 0) throw FieldError("count", "is 0, a batch has at least one query");
  if (count > most) throw Error(ErrorCode::limit_exceeded, "count is " + std::to_string(count) + ", the limit of a batch is " + std::to_string(most));
}

}  // namespace

EvalLevel level_of(v1::EvalLevel level) {
  switch (level) {
    case v1::EVAL_LEVEL_UNSPECIFIED:
    case v1::EVAL_LEVEL_BALANCED: return EvalLevel::balanced;
    case v1::EVAL_LEVEL_FAST: return EvalLevel::fast;
    case v1::EVAL_LEVEL_EXACT: return EvalLevel::exact;
    default: throw FieldError("level", "is " + std::to_string(static_cast<int>(level)) + ", which this version does not know");
  }
}

BatchPlan plan_batch(const v1::EvaluateRequest& request, const BatchLimits& limits) {
  BatchPlan plan;
  plan.level = level_of(request.level());
  const std::uint32_t wanted = request.operations();
  constexpr std::uint32_t known = v1::OPERATION_EVALUATE | v1::OPERATION_PDF | v1::OPERATION_SAMPLE;
  if (wanted == 0 || (wanted & ~known) != 0) throw FieldError("operations", "is " + std::to_string(wanted) + ", wanted is a sum of 1, 2 and 4");
  plan.evaluate = (wanted & v1::OPERATION_EVALUATE) != 0;
  plan.pdf = (wanted & v1::OPERATION_PDF) != 0;
  plan.sample = (wanted & v1::OPERATION_SAMPLE) != 0;
  const std::uint64_t count = request.count();
  require_count(count, limits.max_queries);
  const bool pairs = plan.evaluate || plan.pdf;
  require_bytes("wi", request.wi(), pairs ? count * vector_bytes : 0);
  if (request.wo().size() != vector_bytes) require_bytes("wo", request.wo(), count * vector_bytes);
  if (plan.sample) {
    if (request.random_case() == v1::EvaluateRequest::RANDOM_NOT_SET) throw FieldError("random", "is missing: numbers or seeded must be set, where do the random numbers come from?");
    if (request.has_numbers()) require_bytes("numbers", request.numbers(), count * vector_bytes);
  } else if (request.random_case() != v1::EvaluateRequest::RANDOM_NOT_SET) {
    throw FieldError("random", "numbers are set, but OPERATION_SAMPLE is not");
  }
  switch (request.transport()) {
    case v1::TRANSPORT_MODE_UNSPECIFIED:
    case v1::TRANSPORT_MODE_RADIANCE:
    case v1::TRANSPORT_MODE_IMPORTANCE: break;
    default: throw FieldError("transport", "is " + std::to_string(static_cast<int>(request.transport())) + ", which this version does not know");
  }
  plan.cost = count * (std::uint64_t{plan.evaluate} + std::uint64_t{plan.pdf} + std::uint64_t{plan.sample});
  return plan;
}

std::uint64_t answer_bytes(const BatchPlan& plan, std::uint64_t count, int channels, const BatchLimits& limits) {
  const auto c = static_cast<std::uint64_t>(channels);
  const std::uint64_t floats = (plan.evaluate ? c : 0) + (plan.pdf ? 1 : 0) + (plan.sample ? 4 + c : 0);
  const std::uint64_t bytes = count * floats * sizeof(float);
  if (bytes > limits.max_message_bytes) {
    throw Error(ErrorCode::limit_exceeded, "the answer would have " + std::to_string(bytes) + " bytes, the limit of a message is " + std::to_string(limits.max_message_bytes) + ": ask for fewer queries at once");
  }
  return bytes;
}

std::uint64_t plan_albedo(const v1::AlbedoRequest& request, const BatchLimits& limits) {
  (void)level_of(request.level());
  require_count(request.count(), limits.max_queries / albedo_cost + 1);
  require_bytes("wo", request.wo(), request.count() * vector_bytes);
  return request.count() * albedo_cost;
}

}  // namespace brdf::service
