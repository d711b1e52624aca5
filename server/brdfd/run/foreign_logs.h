// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brdf::service {

/// What gRPC and protobuf have to say goes into the daemon's log, in its form and by its level: strangers cause most of it, by
/// handshakes that fail and messages that are none. Before the first thread of gRPC.
void route_foreign_logs() noexcept;

}  // namespace brdf::service
