// SPDX-License-Identifier: Apache-2.0
// What unary calls answer: each plans in the reactor and answers on a worker.
#pragma once

#include "brdf/v1/brdf_service.pb.h"
#include "rpc/pooled_call.h"

namespace brdf::service {

/// Requests and responses must live until the call ends. Each throws what a call may end with.
void check_list(const v1::ListMaterialsRequest& request);
/// A page of at most `max_bytes` and one material more. False when stopped. Precondition: `request` passed check_list.
bool list_page(const Catalogue& catalogue, const v1::ListMaterialsRequest& request, std::uint64_t max_bytes, v1::ListMaterialsResponse& response, const Stop& stop);

PlannedCall plan_list(Serving& serving, const v1::ListMaterialsRequest& request, v1::ListMaterialsResponse& response);
PlannedCall plan_get(Serving& serving, const v1::GetMaterialRequest& request, v1::GetMaterialResponse& response);
PlannedCall plan_evaluate(Serving& serving, const v1::EvaluateRequest& request, v1::EvaluateResponse& response);
PlannedCall plan_albedo_call(Serving& serving, const v1::AlbedoRequest& request, v1::AlbedoResponse& response);
PlannedCall plan_similar(Serving& serving, const v1::FindSimilarRequest& request, v1::FindSimilarResponse& response);

}  // namespace brdf::service
