// SPDX-License-Identifier: Apache-2.0
// What the transport alone costs: the daemon's messages over the daemon's transport, and no work.
#pragma once

#include <string>

namespace brdf::load {

/// Serves Evaluate on `address` until SIGTERM: the planes of `wi` come back as the values, which are as many bytes for three channels. Prints
/// a line when it is ready.
int serve_echo(const std::string& address);

}  // namespace brdf::load
