// SPDX-License-Identifier: Apache-2.0
// Ends a connection that gRPC holds, which gRPC itself offers no way to.
#pragma once

#include "run/connection_figures.h"

namespace brdf::service {

/// Shuts the connection down in both directions; gRPC sees its end and takes it down. The peer's name, or nothing where the connection
/// is gone already. Peers of unix sockets have no names: of these, the one goes in
/// whose unread bytes the most streams are reset.
std::string cut_connection(const ConnectionFigures& connection);

}  // namespace brdf::service
