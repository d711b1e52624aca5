// SPDX-License-Identifier: Apache-2.0
#include "encode/recipes.h"

#include <algorithm>

namespace brdf::encode {
namespace {

constexpr std::uint64_t slices_from = 300;       // bytes: below, the ndf alone would take a quarter of the file
constexpr int quick_variants = 1;                // bases of an effort that has no time for a second azimuth
constexpr std::uint64_t fewest = 120;            // coefficients per channel that may be chosen from in the smallest file
constexpr std::uint64_t everything_from = 6000;  // bytes: from here on a file may hold every number of the instrument, or

/// from fewer on, of an instrument with few numbers: a quarter of a byte for each.
std::uint64_t room_for_everything(const residual::SliceFrame& f, int channels) noexcept {
  const std::uint64_t nodes = static_cast<std::uint64_t>(f.width) * static_cast<std::uint64_t>(f.half_height()) * f.theta_i.size();
  return std::clamp(nodes * static_cast<std::uint64_t>(channels) / 4, slices_from, everything_from);
}

/// In the order in which they are tried.
constexpr Candidate::SliceSettings slice_settings[] = {{8, 4, 0}, {8, 1, 0}, {6, 4, 0}, {12, 4, 0}, {8, 0, 0}};

int slice_coefficients_for(std::uint64_t bytes) noexcept {
  return static_cast<int>(std::clamp<std::uint64_t>(bytes * 6 / 10 + 700, 1000, Candidate::largest_matrix));
}

std::vector<residual::BasisCodes> table_variants(const residual::BasisCodes& basis, int count) {
  std::vector<residual::BasisCodes> out;
  constexpr struct {
    int table, kappa_h, kappa_d;
  } changes[] = {{0, 0, 0}, {1, 3, 4}, {3, 6, 0}, {0, 6, 4}, {2, 6, 0}, {1, 0, 0}, {0, 3, 0}, {1, 3, 0}, {3, 9, 0}, {2, 9, 0}, {1, 6, 0}, {3, 3, 4}};
  for (const auto& change : changes) {
    if (static_cast<int>(out.size()) == count) break;
    residual::BasisCodes b = basis;
    b.table = static_cast<std::uint8_t>(change.table);
    b.kappa_h = static_cast<std::uint8_t>(std::clamp(b.kappa_h + change.kappa_h, 0, 31));
    b.kappa_d = static_cast<std::uint8_t>(std::clamp(b.kappa_d + change.kappa_d, 0, 15));
    out.push_back(b);
  }
  return out;
}

}  // namespace

Azimuths azimuths(const Measurement& m, SymmetryMode reciprocity, SymmetryMode mirror, const Asymmetry& asymmetry, const EffortStep& effort) {
  using residual::Azimuth;
  const auto* table = std::get_if<HalfDifferenceTable>(&m.table);
  if (table != nullptr && !table->full_circle) {  // half a circle is all that such a table has
    if (mirror == SymmetryMode::keep) return {Azimuth::reciprocal};
    const bool open = mirror == SymmetryMode::automatic && asymmetry.mirror >= negligible_asymmetry && effort.variants > quick_variants;
    return open ? Azimuths{Azimuth::symmetric, Azimuth::reciprocal} : Azimuths{Azimuth::symmetric};
  }
  if (reciprocity == SymmetryMode::enforce) return {Azimuth::symmetric};
  if (reciprocity == SymmetryMode::keep) return {Azimuth::one_way};
  // odd harmonics of data that have none are rounding errors
  return asymmetry.reciprocity < negligible_asymmetry ? Azimuths{Azimuth::symmetric} : Azimuths{Azimuth::one_way, Azimuth::symmetric};
}

std::vector<Recipe> recipes(const SourceData& source, const std::vector<residual::BasisCodes>& bases, const Azimuths& azimuths, std::uint64_t bytes) {
  const EffortStep& effort = source.effort;
  const int coefficients = static_cast<int>(std::min<std::uint64_t>(static_cast<std::uint64_t>(effort.coefficients), fewest + 2 * bytes));
  const bool one_way = azimuths.front() == residual::Azimuth::one_way;
  const std::optional<residual::SliceFrame> frame = one_way && bytes >= slices_from ? slice_frame(source.measurement, 8) : std::nullopt;
  const bool slices = frame.has_value();
  // a measurement with slices of its own rarely gains from more than one basis besides
  const std::size_t kept = slices ? std::max<std::size_t>(bases.size() / 2, 1) : bases.size();
  std::vector<Recipe> out;
  for (const residual::Azimuth azimuth : azimuths) {
    const std::size_t tried = azimuth == residual::Azimuth::reciprocal && azimuths.size() > 1 ? std::max<std::size_t>(kept / 3, 1) : kept;
    for (std::size_t i = 0; i < std::min(tried, bases.size()); ++i) out.push_back({bases[i], azimuth, {}, coefficients});
  }
  if (!slices) return out;
  for (int i = 0; i < effort.slice_variants; ++i) {
    Candidate::SliceSettings s = slice_settings[i];
    s.coefficients = slice_coefficients_for(bytes);
    out.push_back({bases.front(), residual::Azimuth::one_way, s, 0});
  }
  const std::uint64_t room = room_for_everything(*frame, source.measurement.channels.count);
  if (bytes >= room)
    out.push_back({bases.front(), residual::Azimuth::one_way, Candidate::SliceSettings{bytes < 4 * room ? 12 : 16, 4, static_cast<int>(residual::max_coefficients)}, 0});
  return out;
}

std::optional<Candidate> make_candidate(const SourceData& source, const Recipe& recipe) {
  if (recipe.slices) return Candidate::in_slices(source, recipe.basis, *recipe.slices);
  return Candidate::half_difference(source, recipe.basis, recipe.azimuth, recipe.coefficients);
}

ErrorReport choose_table(Encoded& e, int count, EvalLevel level, const Verification& verification) {
  double best = -1e9;
  Encoded chosen;
  ErrorReport report;
  for (const residual::BasisCodes& basis : table_variants(e.content.residual.basis, count)) {
    Encoded trial = e;
    trial.content.residual.basis = basis;
    trial.bytes = container::pack(trial.content);
    const ErrorReport r = verification.score(trial.bytes, EvalLevel::balanced);
    if (!chosen.bytes.empty() && merit(r) <= best) continue;
    best = merit(r);
    report = r;
    chosen = std::move(trial);
  }
  e = std::move(chosen);
  return level == EvalLevel::balanced ? report : verification.score(e.bytes, level);
}

}  // namespace brdf::encode
