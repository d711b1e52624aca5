// SPDX-License-Identifier: Apache-2.0
// TLS of listeners and of the client that checks health.
#pragma once

#include "config/listen_address.h"
#include "config/settings.h"

#include <grpcpp/security/credentials.h>
#include <grpcpp/security/server_credentials.h>

#include <memory>

namespace brdf::service {

/// A unix socket has none: who may open it is a matter of its folder. Elsewhere TLS where a certificate is set, with the
/// client's certificate required where a CA for it is; files that change are read again. Throws Error(io) for a file that
/// cannot be read.
std::shared_ptr<grpc::ServerCredentials> listener_credentials(const ListenAddress& address, const Settings& settings);

}  // namespace brdf::service
