// SPDX-License-Identifier: Apache-2.0
// brdfd: the daemon that renderers ask.
#include "run/command.h"
#include "run/message_memory.h"
#include "run/raise_descriptors.h"

#include <absl/synchronization/mutex.h>

int main(int argc, char** argv) {
  // Debian's abseil is built without NDEBUG, where every lock that gRPC takes is entered into a graph of orders: 7 % of the daemon's time.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  brdf::service::raise_descriptors();
  brdf::service::keep_message_memory();
  return brdf::service::run_command(argc, argv);
}
