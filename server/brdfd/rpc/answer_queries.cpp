// SPDX-License-Identifier: Apache-2.0
#include "rpc/answers.h"
#include "rpc/material_message.h"
#include "shared/material_name.h"

#include <optional>

namespace brdf::service {
namespace {

/// The version, its error at what is asked for.
template <class Response>
void name_version(Response& response, const MaterialVersion& version, int refinements, EvalLevel level) {
  response.set_version(version_name(version.id, version.version));
  if (const RecordedError* e = version.error(refinements, level)) fill(*response.mutable_error(), *e);
}

}  // namespace

PlannedCall plan_evaluate(Serving& serving, const v1::EvaluateRequest& request, v1::EvaluateResponse& response) {
  const BatchPlan plan = plan_batch(request, serving.limits);
  VersionHandle version = find_version(*serving.repository.catalogue(), "material", request.material());
  const std::uint64_t bytes = version->cut_at(request.prefix_bytes());
  answer_bytes(plan, request.count(), version->info.channels.count, serving.limits);
  // Building tables is not brief.
  std::optional<Material> ready = plan.cost <= brief_cost ? serving.tables.find(*version, plan.level, bytes, plan.sampling()) : std::nullopt;
  const bool brief = ready.has_value();
  return {plan.cost, [&serving, &request, &response, plan, version = std::move(version), bytes, ready = std::move(ready)](const Call& call) {
            const Material material = ready ? *ready : serving.tables.get(version, plan.level, bytes, plan.sampling());
            name_version(response, *version, version->refinements_in(bytes), plan.level);
            if (!answer_batch(material, plan, request, response, [&call] { return call.is_over(); })) return false;
            const std::uint64_t n = request.count();
            serving.metrics.count_queries(plan.evaluate ? n : 0, plan.pdf ? n : 0, plan.sample ? n : 0);
            return true;
          }, brief};
}

PlannedCall plan_albedo_call(Serving& serving, const v1::AlbedoRequest& request, v1::AlbedoResponse& response) {
  const std::uint64_t cost = plan_albedo(request, serving.limits);
  const EvalLevel level = level_of(request.level());
  VersionHandle version = find_version(*serving.repository.catalogue(), "material", request.material());
  const std::uint64_t bytes = version->cut_at(request.prefix_bytes());
  return {cost, [&serving, &request, &response, cost, level, version = std::move(version), bytes](const Call& call) {
            const Material material = serving.tables.get(version, level, bytes, true);
            name_version(response, *version, version->refinements_in(bytes), level);
            if (!answer_albedo(material, request, response, [&call] { return call.is_over(); })) return false;
            serving.metrics.count_queries(0, 0, cost);
            return true;
          }};
}

}  // namespace brdf::service
