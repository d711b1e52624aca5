// SPDX-License-Identifier: Apache-2.0
#include "fit/moves.h"

#include "fit/starting_point.h"

#include <algorithm>
#include <utility>

namespace brdf::fit {
namespace {

LobeSet without(LobeSet set, std::size_t index) {
  set.lobes.erase(set.lobes.begin() + static_cast<std::ptrdiff_t>(index));
  return set;
}

Move adding(const PreparedSamples& samples, std::size_t screening, const LobeSet& to, LobeKind kind, int starts) {
  Move move;
  move.kind = kind;
  for (int i = 0; i < starts; ++i) {
    LobeSet set = to;
    set.lobes.push_back(starting_ggx(samples, screening, to, kind, i));
    move.starts.push_back(std::move(set));
  }
  return move;
}

}  // namespace

std::vector<Move> possible_moves(const PreparedSamples& samples, std::size_t screening, const LobeSet& present,
                                 std::size_t newest, const FitOptions& options) {
  const std::vector<Lobe>& lobes = present.lobes;
  const auto position = [&](LobeKind kind) {
    return static_cast<std::size_t>(
        std::find_if(lobes.begin(), lobes.end(), [&](const Lobe& l) { return l.kind == kind; }) - lobes.begin());
  };
  const bool full = lobes.size() >= static_cast<std::size_t>(options.max_lobes);
  const std::size_t lambert = position(LobeKind::lambert);
  const bool try_retro = options.retro && position(LobeKind::retro_ggx) == lobes.size();

  std::vector<Move> moves;
  if (!full) {
    moves.push_back(adding(samples, screening, present, LobeKind::ggx, options.starts));
    if (try_retro) moves.push_back(adding(samples, screening, present, LobeKind::retro_ggx, options.starts));
    if (lambert == lobes.size()) {
      Move move;
      move.starts.push_back(present);
      move.starts.back().lobes.push_back(starting_lambert(samples));
      moves.push_back(std::move(move));
    }
  } else if (lambert != lobes.size()) {
    // below the limit the same is reached by adding one and then removing Lambert
    Move move = adding(samples, screening, without(present, lambert), LobeKind::ggx, options.starts);
    move.action = Move::Action::replace;
    move.index = lambert;
    moves.push_back(std::move(move));
  }
  for (std::size_t l = 0; lobes.size() > 1 && l < lobes.size(); ++l) {
    if (l == newest) continue;
    moves.push_back({Move::Action::remove, l, lobes[l].kind, {without(present, l)}});
  }
  return moves;
}

}  // namespace brdf::fit
