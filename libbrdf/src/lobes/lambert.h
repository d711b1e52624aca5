// SPDX-License-Identifier: Apache-2.0
// The diffuse lobe.
#pragma once

namespace brdf::lobes {

inline constexpr double inv_pi = 0.31830988618379067154;

/// f = rho / pi (Lambert 1760), for both directions above the horizon.
template <class T>
inline T lambert(const T& rho) noexcept {
  return rho * inv_pi;
}

}  // namespace brdf::lobes
