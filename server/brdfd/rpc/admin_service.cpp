// SPDX-License-Identifier: Apache-2.0
#include "rpc/admin_service.h"

#include "config/log.h"
#include "query/field_error.h"
#include "rpc/pooled_call.h"
#include "shared/excerpt.h"
#include "shared/material_name.h"

#include <algorithm>
#include <span>

namespace brdf::service {
namespace {

constexpr std::uint64_t load_cost = 1000;
constexpr std::size_t most_told = 1000;  // files that were refused, of an answer that must fit into a message

std::string id_of(const std::string& name) {
  const auto parsed = parse_material_name(name);
  if (!parsed || !parsed->version.empty()) throw FieldError("name", "is " + excerpt(name) + ", wanted is materials/{material}");
  return parsed->id;
}

}  // namespace

PollResult poll_repository(Serving& serving) {
  PollResult result = serving.repository.poll();
  const std::uint32_t changed = result.added + result.replaced + result.removed;
  serving.metrics.count_poll(changed, result.refused.size());
  if (changed != 0) {
    log_event(Severity::info, "repository.changed", {{"materials", std::to_string(result.materials)}, {"added", std::to_string(result.added)},
                                                     {"replaced", std::to_string(result.replaced)}, {"removed", std::to_string(result.removed)}});
  }
  for (const Refusal& r : result.refused) log_event(Severity::debug, "repository.refused", {{"material", r.id}, {"reason", r.reason}});
  return result;
}

grpc::ServerUnaryReactor* AdminServiceImpl::LoadMaterial(Context* context, const v1::LoadMaterialRequest* request, v1::LoadMaterialResponse* response) {
  return start_pooled(serving_, Method::load_material, Role::admin, context, [&]() -> PlannedCall {
    return {load_cost, [this, response, id = id_of(request->name())](const Call&) {
              const VersionHandle version = serving_.repository.load(id);
              response->set_version(version_name(version->id, version->version));
              log_event(Severity::info, "material.loaded", {{"material", id}, {"version", version->version}});
              return true;
            }};
  });
}

grpc::ServerUnaryReactor* AdminServiceImpl::UnloadMaterial(Context* context, const v1::UnloadMaterialRequest* request, v1::UnloadMaterialResponse*) {
  return start_pooled(serving_, Method::unload_material, Role::admin, context, [&]() -> PlannedCall {
    return {load_cost, [this, id = id_of(request->name())](const Call&) {
              if (!serving_.repository.unload(id)) throw StatusError(grpc::StatusCode::NOT_FOUND, "MATERIAL_NOT_FOUND", material_name(id) + " is not loaded");
              log_event(Severity::info, "material.unloaded", {{"material", id}});
              return true;
            }};
  });
}

grpc::ServerUnaryReactor* AdminServiceImpl::ReloadRepository(Context* context, const v1::ReloadRepositoryRequest*, v1::ReloadRepositoryResponse* response) {
  return start_pooled(serving_, Method::reload_repository, Role::admin, context, [&]() -> PlannedCall {
    return {load_cost, [this, response](const Call&) {
              const PollResult result = poll_repository(serving_);
              response->set_materials(result.materials);
              response->set_added(result.added);
              response->set_replaced(result.replaced);
              response->set_removed(result.removed);
              for (const Refusal& r : std::span(result.refused).first(std::min(result.refused.size(), most_told))) {
                v1::RefusedFile* refused = response->add_refused();
                refused->set_name(material_name(r.id));
                refused->set_reason(utf8_prefix(r.reason, 1024));
              }
              return true;
            }};
  });
}

}  // namespace brdf::service
