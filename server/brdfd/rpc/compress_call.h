// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf/v1/brdf_service.pb.h"
#include "rpc/call.h"

#include <grpcpp/support/server_callback.h>

namespace brdf::service {

/// A reactor of its own life: stores the upload chunk by chunk on a thread for it, then waits for a place among the
/// compressions, and publishes the verified result.
grpc::ServerBidiReactor<v1::CompressRequest, v1::CompressResponse>* start_compress(Serving& serving, grpc::CallbackServerContext* context);

}  // namespace brdf::service
