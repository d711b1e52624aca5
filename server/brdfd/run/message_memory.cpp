// SPDX-License-Identifier: Apache-2.0
#include "run/message_memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace brdf::service {

void keep_message_memory() noexcept {
#ifdef __GLIBC__
  constexpr int megabyte = 1 << 20;
  ::mallopt(M_MMAP_THRESHOLD, 8 * megabyte);  // the largest message and its answer come from an arena
  ::mallopt(M_TRIM_THRESHOLD, 4 * megabyte);
  ::mallopt(M_TOP_PAD, megabyte);
  ::mallopt(M_ARENA_MAX, 8);
#endif
}

}  // namespace brdf::service
