// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace brdf::service {

/// The protocol of sd_notify(3): one datagram to $NOTIFY_SOCKET, where systemd set it. A few lines of code instead of a
/// library; what goes wrong is systemd's to notice.
void notify_systemd(std::string_view state) noexcept;

}  // namespace brdf::service
