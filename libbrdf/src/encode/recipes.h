// SPDX-License-Identifier: Apache-2.0
// The ways to write a material that an effort tries.
#pragma once

#include "encode/asymmetry.h"
#include "encode/candidate.h"
#include "encode/verification.h"
#include "encode/source_data.h"

#include <brdf/encode.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace brdf::encode {

struct Recipe {
  residual::BasisCodes basis;                        ///< in slices: of the balanced table
  residual::Azimuth azimuth = residual::Azimuth::one_way;
  std::optional<Candidate::SliceSettings> slices;    ///< none: half/difference coordinates
  int coefficients = 0;                              ///< of half/difference coordinates
};

/// Functions of phi_d that may be tried, the usual one first; the second one is tried with a third of the bases.
using Azimuths = std::vector<residual::Azimuth>;

/// What a measurement and the options leave open. A table of half a circle is reciprocal whatever is asked for; so are, unless
/// asked otherwise, data without asymmetry. Only such a table can be asymmetric in a mirror and be kept so.
Azimuths azimuths(const Measurement& m, SymmetryMode reciprocity, SymmetryMode mirror, const Asymmetry& asymmetry, const EffortStep& effort);

/// For a file of so many bytes, the likeliest of each kind first: half/difference, by azimuth, then slices.
std::vector<Recipe> recipes(const SourceData& source, const std::vector<residual::BasisCodes>& bases, const Azimuths& azimuths, std::uint64_t bytes);

/// None when the measurement has no slices.
std::optional<Candidate> make_candidate(const SourceData& source, const Recipe& recipe);

/// Gives a file in slices the best of the first `count` balanced tables: the coefficients stay, for tables are resampled from
/// them. Returns its report at `level`.
ErrorReport choose_table(Encoded& e, int count, EvalLevel level, const Verification& verification);

}  // namespace brdf::encode
