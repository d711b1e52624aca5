// SPDX-License-Identifier: Apache-2.0
#include "run/raise_descriptors.h"

#include <sys/resource.h>

namespace brdf::service {

void raise_descriptors() noexcept {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace brdf::service
