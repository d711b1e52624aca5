// SPDX-License-Identifier: Apache-2.0
#include "rpc/brdf_service.h"

#include "rpc/answers.h"
#include "rpc/compress_call.h"
#include "rpc/download.h"

namespace brdf::service {

grpc::ServerUnaryReactor* BrdfServiceImpl::ListMaterials(Context* context, const v1::ListMaterialsRequest* request, v1::ListMaterialsResponse* response) {
  return start_pooled(serving_, Method::list_materials, Role::read, context, [&] { return plan_list(serving_, *request, *response); });
}

grpc::ServerUnaryReactor* BrdfServiceImpl::GetMaterial(Context* context, const v1::GetMaterialRequest* request, v1::GetMaterialResponse* response) {
  return start_pooled(serving_, Method::get_material, Role::read, context, [&] { return plan_get(serving_, *request, *response); });
}

grpc::ServerWriteReactor<v1::DownloadMaterialResponse>* BrdfServiceImpl::DownloadMaterial(Context* context, const v1::DownloadMaterialRequest* request) {
  return start_download(serving_, context, request);
}

grpc::ServerUnaryReactor* BrdfServiceImpl::Evaluate(Context* context, const v1::EvaluateRequest* request, v1::EvaluateResponse* response) {
  return start_pooled(serving_, Method::evaluate, Role::read, context, [&] { return plan_evaluate(serving_, *request, *response); });
}

grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse>* BrdfServiceImpl::EvaluateStream(Context* context) {
  return streams_.start(serving_, context);
}

grpc::ServerUnaryReactor* BrdfServiceImpl::Albedo(Context* context, const v1::AlbedoRequest* request, v1::AlbedoResponse* response) {
  return start_pooled(serving_, Method::albedo, Role::read, context, [&] { return plan_albedo_call(serving_, *request, *response); });
}

grpc::ServerUnaryReactor* BrdfServiceImpl::FindSimilar(Context* context, const v1::FindSimilarRequest* request, v1::FindSimilarResponse* response) {
  return start_pooled(serving_, Method::find_similar, Role::read, context, [&] { return plan_similar(serving_, *request, *response); });
}

grpc::ServerBidiReactor<v1::CompressRequest, v1::CompressResponse>* BrdfServiceImpl::Compress(Context* context) {
  return start_compress(serving_, context);
}

grpc::ServerWriteReactor<v1::WatchMaterialsResponse>* BrdfServiceImpl::WatchMaterials(Context* context, const v1::WatchMaterialsRequest* request) {
  return watchers_.start(serving_, context, request);
}

}  // namespace brdf::service
