// SPDX-License-Identifier: Apache-2.0
#include "encode/purpose.h"

#include <limits>

namespace brdf::encode {

FittedFor purpose_of(const EncodeOptions& options) {
  const MaterialProfile& asked = *options.profile;
  FittedFor p;
  for (int k = 0; k < profile_operations; ++k)
    if (asked.asked(static_cast<ProfileOperation>(k))) p.operations = static_cast<std::uint8_t>(p.operations | 1U << k);
  p.level = options.level;
  if (asked.range_i.least <= asked.range_i.most) {
    p.theta_i_least = asked.range_i.least;
    p.theta_i_most = asked.range_i.most;
    p.theta_o_least = asked.range_o.least;
    p.theta_o_most = asked.range_o.most;
  }
  p.share = options.profile_share;
  p.footprint_pixels = asked.footprint_pixels();
  p.rms = p.log_error = std::numeric_limits<double>::infinity();
  return p;
}

ProfileError record_purpose(Encoded& e, const Verification& verification, const EncodeOptions& options) {
  const ProfileError found = verification.score(e.bytes, options.level).profile;
  e.content.purpose = purpose_of(options);
  e.content.purpose->rms = found.rms;
  e.content.purpose->log_error = found.log_error;
  e.bytes = container::pack(e.content);
  return found;
}

}  // namespace brdf::encode
