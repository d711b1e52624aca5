// SPDX-License-Identifier: Apache-2.0
// The ways to write a material that an effort tries.
#pragma once

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
  bool reciprocal = false;
  std::optional<Candidate::SliceSettings> slices;    ///< none: half/difference coordinates
  int coefficients = 0;                              ///< of half/difference coordinates
};

/// Which parities of phi_d may be tried.
struct Parities {
  bool one_way = false, reciprocal = false;
};

/// What a measurement and the options leave open. A table of half a circle is reciprocal whatever is asked for; so are, unless
/// asked otherwise, data without `asymmetry` (log_mae, asymmetry.h).
Parities parities(const Measurement& m, SymmetryMode reciprocity, double asymmetry);

/// For a file of so many bytes, the likeliest of each kind first: half/difference one way, then reciprocal, then slices.
std::vector<Recipe> recipes(const SourceData& source, const std::vector<residual::BasisCodes>& bases, Parities parities, std::uint64_t bytes);

/// None when the measurement has no slices.
std::optional<Candidate> make_candidate(const SourceData& source, const Recipe& recipe);

/// Gives a file in slices the best of the first `count` balanced tables: the coefficients stay, for tables are resampled from
/// them. Returns its report at `level`.
ErrorReport choose_table(Encoded& e, int count, EvalLevel level, const Verification& verification);

}  // namespace brdf::encode
