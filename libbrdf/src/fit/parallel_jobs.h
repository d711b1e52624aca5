// SPDX-License-Identifier: Apache-2.0
// Runs independent jobs on a few threads.
#pragma once

#include <cstddef>
#include <functional>

namespace brdf::fit {

/// Calls job(i, on_caller) for every i in [0, count), at most `threads` at a time, the calling thread among them. Every
/// job must write only what belongs to its index, so that results do not depend on the number of threads. Rethrows the
/// exception of the lowest index after all have ended.
void run_jobs(std::size_t count, int threads, const std::function<void(std::size_t i, bool on_caller)>& job);

}  // namespace brdf::fit
