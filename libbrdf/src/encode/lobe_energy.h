// SPDX-License-Identifier: Apache-2.0
// Lobes that were fitted to a part of all directions, kept from shining in the others.
#pragma once

#include <brdf/lobes.h>

namespace brdf::encode {

/// Lowers what the lobes reflect at grazing angles (f90), and only then all of them, until no directional albedo of their sum
/// exceeds `limit`. Lobes that do not are left as they are.
void bound_lobes(LobeSet& lobes, double limit);

}  // namespace brdf::encode
