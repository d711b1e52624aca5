// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf/v1/brdf_service.pb.h"
#include "rpc/call.h"

#include <grpcpp/support/server_callback.h>

namespace brdf::service {

/// Where a download ends: one of the file's boundaries. Throws Error(invalid_argument) for a target that is no number.
std::uint64_t download_end(const MaterialVersion& version, const v1::DownloadMaterialRequest& request);

/// A reactor of its own life.
grpc::ServerWriteReactor<v1::DownloadMaterialResponse>* start_download(Serving& serving, grpc::CallbackServerContext* context, const v1::DownloadMaterialRequest* request);

}  // namespace brdf::service
