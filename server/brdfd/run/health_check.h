// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace brdf::service {

/// `brdfd --health-check ADDR`: 0 and "SERVING" on stdout, else 1 and why on stderr. A listener with TLS is asked with
/// the roots of `ca` (PEM).
int check_health(const std::string& address, const std::string& ca, std::chrono::milliseconds deadline);

}  // namespace brdf::service
