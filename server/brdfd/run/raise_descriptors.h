// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brdf::service {

/// Takes as many descriptors as the system allows: gRPC stops listening for good when accepting a connection fails for want of one, and
/// the usual 1024 are no more than a crowd of clients.
void raise_descriptors() noexcept;

}  // namespace brdf::service
