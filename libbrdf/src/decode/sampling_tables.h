// SPDX-License-Identifier: Apache-2.0
// The sampling tables of a file at a level, for who writes them down.
#pragma once

#include "sample/density.h"

#include <brdf/material.h>

#include <cstddef>
#include <memory>
#include <span>

namespace brdf::decode {

/// Throws what Material::decode throws.
std::shared_ptr<const Material::Sampling> sampling_tables(std::span<const std::byte> bytes, const DecodeOptions& options);

}  // namespace brdf::decode
