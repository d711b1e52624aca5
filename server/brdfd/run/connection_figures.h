// SPDX-License-Identifier: Apache-2.0
// What gRPC counts of its connections, as channelz gives it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace brdf::service {

struct ConnectionFigures {
  std::int64_t id = 0;        ///< never used again
  std::string address;        ///< of the peer, in base64 (4 or 16 bytes); empty for a unix socket
  std::uint16_t port = 0;     ///< of the peer
  std::uint64_t streams = 0;  ///< begun, and not taken down yet
};

/// Of every connection of every server of this process. Empty where gRPC was built or told to keep no figures.
std::vector<ConnectionFigures> connection_figures();

}  // namespace brdf::service
