// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

namespace brdf::service {

/// Who to ask, and how: TLS where `ca` is set, mutual TLS with the other two. Files are PEM.
struct HealthQuestion {
  std::string address, ca, certificate, key;
};

/// `brdfd --health-check ADDR`: 0 and "SERVING" on stdout, else 1 and why on stderr. Throws Error for a file that cannot be read.
int check_health(const HealthQuestion& question, std::chrono::milliseconds deadline);

}  // namespace brdf::service
