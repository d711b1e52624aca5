// SPDX-License-Identifier: Apache-2.0
// TLS of listeners.
#pragma once

#include "config/listen_address.h"
#include "config/settings.h"

#include <grpcpp/security/server_credentials.h>

#include <memory>

namespace brdf::service {

/// Whether the PEM files of the settings can be served with: gRPC itself would start and then refuse every handshake. Throws
/// Error: io for a file that cannot be read, malformed for one that is no certificate or no key, or where the two are not a pair.
void check_tls_files(const Settings& settings);

/// A unix socket has none: who may open it is a matter of its folder. Elsewhere TLS where a certificate is set, with the
/// client's certificate required where a CA for it is; files that change are read again.
std::shared_ptr<grpc::ServerCredentials> listener_credentials(const ListenAddress& address, const Settings& settings);

}  // namespace brdf::service
