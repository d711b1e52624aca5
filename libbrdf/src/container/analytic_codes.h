// SPDX-License-Identifier: Apache-2.0
// The payload of an analytic chunk: the kind and the parameters of a model, as floats.
#pragma once

#include "container/content.h"

#include <brdf/analytic.h>

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::container {

/// Bits of the first byte above the kind, which is the index of the alternative in AnalyticModel.
inline constexpr unsigned analytic_kind_bits = 0x0F, analytic_anisotropic = 0x10, analytic_compensated = 0x20, analytic_reserved = 0xC0;

/// `component` says how many channels there are, and must say of the symmetries what the model has. Throws Error(malformed)
/// or, of a kind that is not known, Error(unsupported).
AnalyticModel read_analytic(std::span<const std::byte> payload, const Component& component);

/// `model` is sound.
std::vector<std::byte> write_analytic(const AnalyticModel& model);

}  // namespace brdf::container
