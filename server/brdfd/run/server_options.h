// SPDX-License-Identifier: Apache-2.0
// What every server of the daemon has: limits against clients that say too much, too little or nothing.
#pragma once

#include "config/settings.h"

#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <memory>
#include <string>
#include <vector>

namespace brdf::service {

void set_server_options(grpc::ServerBuilder& builder, const Settings& settings);

/// Adds the addresses with their credentials and starts. `bound` tells where it listens. Throws Error(io) for an address
/// that is taken or not to be had.
std::unique_ptr<grpc::Server> start_listening(grpc::ServerBuilder& builder, const TextList& listen, const Settings& settings, std::vector<std::string>& bound);

}  // namespace brdf::service
