// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf/v1/admin_service.grpc.pb.h"
#include "rpc/serving.h"

namespace brdf::service {

/// A look at the repository, with what it found in the log and the metrics. Throws Error(io).
PollResult poll_repository(Serving& serving);

class AdminServiceImpl : public v1::AdminService::CallbackService {
 public:
  explicit AdminServiceImpl(Serving& serving) : serving_(serving) {}

  using Context = grpc::CallbackServerContext;
  grpc::ServerUnaryReactor* LoadMaterial(Context*, const v1::LoadMaterialRequest*, v1::LoadMaterialResponse*) override;
  grpc::ServerUnaryReactor* UnloadMaterial(Context*, const v1::UnloadMaterialRequest*, v1::UnloadMaterialResponse*) override;
  grpc::ServerUnaryReactor* ReloadRepository(Context*, const v1::ReloadRepositoryRequest*, v1::ReloadRepositoryResponse*) override;

 private:
  Serving& serving_;
};

}  // namespace brdf::service
