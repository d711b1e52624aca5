// SPDX-License-Identifier: Apache-2.0
// How far a measurement is from the symmetries that a file may impose on it, and what was done about it.
#pragma once

#include <brdf/encode.h>
#include <brdf/measurement.h>

#include <string>

namespace brdf::encode {

/// Below it an asymmetry is rounding of the source (log_mae).
inline constexpr double negligible_asymmetry = 1e-7;

/// log_mae between the measurement and its average with its mirror image, and with the exchange of the directions.
struct Asymmetry {
  double reciprocity = 0, mirror = 0;
};

/// `quality`: share of the pairs of directions at which log_mae is measured.
Asymmetry measure_asymmetry(const Measurement& m, double quality);

/// What became of reciprocity. `none`: the measurement has no asymmetry. `gain`: merit in dB of the best file that keeps odd harmonics over the best that does not;
/// 0 where only one was tried.
std::string reciprocity_sentence(SymmetryMode mode, bool none, bool reciprocal, bool lobes_alone, double asymmetry, double gain);

/// What became of mirror symmetry. `kept`: the file holds an asymmetry; `gain` as above.
std::string mirror_sentence(SymmetryMode mode, bool kept, bool lobes_alone, double asymmetry, double gain);

}  // namespace brdf::encode
