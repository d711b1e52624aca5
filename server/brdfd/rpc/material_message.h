// SPDX-License-Identifier: Apache-2.0
// Versions of materials as messages.
#pragma once

#include "brdf/v1/material.pb.h"
#include "repository/material_version.h"

namespace brdf::service {

v1::EvalLevel message_of(EvalLevel level) noexcept;
v1::Fitness fitness_of(const RecordedError& error) noexcept;
void fill(v1::RecordedError& message, const RecordedError& error);
void fill(v1::Material& message, const MaterialVersion& version);
/// Of the whole file at the balanced level.
v1::Fitness fitness_of(const MaterialVersion& version) noexcept;
v1::ChannelModel message_of(ChannelModel model) noexcept;

}  // namespace brdf::service
