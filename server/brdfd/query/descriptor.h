// SPDX-License-Identifier: Apache-2.0
// A few dozen numbers in which materials that look alike are near each other.
#pragma once

#include <brdf/material.h>

#include <array>
#include <cstddef>
#include <span>

namespace brdf::service {

/// Pairs of directions of equal elevation, phi_d = 90 degrees: the highlight from its centre (theta_h = 0) to its skirts,
/// seen from above, aslant and flat (theta_d).
inline constexpr std::array<double, 7> descriptor_theta_h{0, 2, 5, 10, 20, 35, 55};
inline constexpr std::array<double, 3> descriptor_theta_d{5, 35, 65};
inline constexpr std::size_t descriptor_size = descriptor_theta_h.size() * descriptor_theta_d.size() * 3;

/// Of x = f cos_i in red, green and blue, the cube root of x / (1 + x/8): lightness as CIE L* has it, with highlights
/// rolled off as a picture does; times the root of the share of half vectors that its angle stands for. XYZ becomes linear sRGB, a spectrum three bands (below 500, 500 to 600, above 600 nm), one
/// channel three equal ones.
using Descriptor = std::array<float, descriptor_size>;

Descriptor describe(const Material& material);

/// The colour that the descriptor sees of values of channels.
std::array<double, 3> descriptor_color(const Channels& channels, std::span<const float> f);

}  // namespace brdf::service
