// SPDX-License-Identifier: Apache-2.0
// FLIP, the difference that an observer sees when flipping between two pictures: Andersson, Nilsson, Akenine-Möller, Oskarsson,
// Åström, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020
// (LDR below), and Andersson, Nilsson, Shirley, Akenine-Möller, "Visualizing Errors in Rendered High Dynamic Range Images",
// Eurographics Short Papers 2021 (HDR below).
#pragma once

#include "image/plane.h"

namespace brdf::render {

/// Pixels per degree of a display 0.7 m wide with 3840 pixels, seen from 0.7 m: the papers' default.
inline constexpr double flip_pixels_per_degree = 0.7 * (3840 / 0.7) * 3.14159265358979323846 / 180;

/// The error map of two low dynamic range pictures, 0 (the same) to 1 at each pixel. `reference` and `candidate` are linear
/// and in [0, 1], as exposed() gives them; what lies outside is clipped. Symmetric. Throws Error invalid_argument (sizes).
Plane flip(const Image& reference, const Image& candidate, double pixels_per_degree = flip_pixels_per_degree);

/// The exposures, in stops, at which HDR-FLIP looks: `count` of them, evenly from `start` to `stop`.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 2;
};

/// 2021 paper, section 3: from the exposure that brings the reference's brightest pixel to 0.85 of the display's range under the
/// ACES tone curve to that which does so with its median, in steps of about a stop.
FlipExposures flip_exposures(const Image& reference);

/// The error map of two pictures of radiance (negative values count as 0): at each pixel the largest FLIP over the exposures
/// that the reference asks for, under the ACES tone curve. Not symmetric, as the reference chooses the exposures.
/// Throws Error invalid_argument (sizes).
Plane hdr_flip(const Image& reference, const Image& candidate, double pixels_per_degree = flip_pixels_per_degree);

}  // namespace brdf::render
