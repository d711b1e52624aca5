// SPDX-License-Identifier: Apache-2.0
// What a file that was made for a profile says of it.
#pragma once

#include "encode/candidate.h"
#include "encode/verification.h"

#include <brdf/encode.h>

namespace brdf::encode {

/// Without errors, which are not known yet; takes as many bytes as with them. `options.profile` is there.
FittedFor purpose_of(const EncodeOptions& options);

/// Measures the whole file at `options.level`, writes that into it and packs it anew.
ProfileError record_purpose(Encoded& e, const Verification& verification, const EncodeOptions& options);

}  // namespace brdf::encode
