// SPDX-License-Identifier: Apache-2.0
// Clients that mean harm. Each works in bounded steps until it is told to end, on loopback or unix sockets.
#pragma once

#include "server/load/setup.h"

#include <atomic>
#include <functional>

namespace brdf::load {

struct HostileCounts {
  std::atomic<std::uint64_t> silent{0}, half_open{0}, random_bytes{0}, resets{0}, bad_calls{0};
  std::atomic<std::uint64_t> not_refused{0};  ///< bad calls that were answered as if they were good
  std::atomic<std::uint64_t> closed{0};       ///< silent connections that the daemon closed
};

/// Gives this thread only the time that nobody else wants: in the world, who means harm brings processors of their own, and what is asked is
/// what the daemon's work for them costs the honest.
void use_idle_time() noexcept;

struct Hostile {
  const Served& served;
  std::string token;  ///< a good one, for those who get further with it
  HostileCounts& counts;

  /// Holds `count` connections that never say anything, on TCP and on the unix socket.
  void stay_silent(const std::atomic<bool>& end, std::size_t count) const;
  /// Preface and settings, then half of a call, then nothing.
  void stay_half_open(const std::atomic<bool>& end, std::size_t count) const;
  /// Bytes of no protocol, and frames whose lengths lie.
  void send_random_bytes(const std::atomic<bool>& end) const;
  /// Calls that are reset as soon as they are sent, so many in all.
  void reset_streams(const std::atomic<bool>& end, std::uint64_t count, double per_second) const;
  /// Messages that are too large, malformed, or ask for what may not be: NaN, wrong sizes, names that are paths, bad tokens.
  void make_bad_calls(const std::atomic<bool>& end) const;
};

}  // namespace brdf::load
