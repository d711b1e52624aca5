// SPDX-License-Identifier: Apache-2.0
// Which call goes where.
#pragma once

#include "brdf/v1/brdf_service.grpc.pb.h"
#include "rpc/evaluate_stream.h"
#include "rpc/serving.h"
#include "rpc/watch.h"

namespace brdf::service {

class BrdfServiceImpl : public v1::BrdfService::CallbackService {
 public:
  BrdfServiceImpl(Serving& serving, Watchers& watchers, EvaluateStreams& streams) : serving_(serving), watchers_(watchers), streams_(streams) {}

  using Context = grpc::CallbackServerContext;
  grpc::ServerUnaryReactor* ListMaterials(Context*, const v1::ListMaterialsRequest*, v1::ListMaterialsResponse*) override;
  grpc::ServerUnaryReactor* GetMaterial(Context*, const v1::GetMaterialRequest*, v1::GetMaterialResponse*) override;
  grpc::ServerWriteReactor<v1::DownloadMaterialResponse>* DownloadMaterial(Context*, const v1::DownloadMaterialRequest*) override;
  grpc::ServerUnaryReactor* Evaluate(Context*, const v1::EvaluateRequest*, v1::EvaluateResponse*) override;
  grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse>* EvaluateStream(Context*) override;
  grpc::ServerUnaryReactor* Albedo(Context*, const v1::AlbedoRequest*, v1::AlbedoResponse*) override;
  grpc::ServerUnaryReactor* FindSimilar(Context*, const v1::FindSimilarRequest*, v1::FindSimilarResponse*) override;
  grpc::ServerBidiReactor<v1::CompressRequest, v1::CompressResponse>* Compress(Context*) override;
  grpc::ServerWriteReactor<v1::WatchMaterialsResponse>* WatchMaterials(Context*, const v1::WatchMaterialsRequest*) override;

 private:
  Serving& serving_;
  Watchers& watchers_;
  EvaluateStreams& streams_;
};

}  // namespace brdf::service
