// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf/v1/brdf_service.pb.h"
#include "rpc/call.h"

#include <grpcpp/support/server_callback.h>

namespace brdf::service {

/// A reactor of its own life: answers up to four batches of the stream at once, in the order of the requests. A client that
/// sends faster than it reads is not read on.
grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse>* start_evaluate_stream(Serving& serving, grpc::CallbackServerContext* context);

}  // namespace brdf::service
