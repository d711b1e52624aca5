// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brdf::service {

/// Makes the allocator keep the memory of messages, some hundred kilobytes each, for the next ones: given back after every call, it costs
/// a page fault for every four kilobytes. What is kept is bounded, some megabytes for each of a few arenas. Before any thread starts.
void keep_message_memory() noexcept;

}  // namespace brdf::service
