// SPDX-License-Identifier: Apache-2.0
#include "path/paired_render.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <string>

namespace brdf::render {
namespace {

constexpr float least_cosine_share = 0.1F;

void add(Film& to, const Film& film) {
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) {
      Film::Pixel& pixel = to.at(x, y);
      const Film::Pixel& more = film.at(x, y);
      pixel.sum += more.sum;
      pixel.luminance2 += more.luminance2;
      pixel.samples += more.samples;
    }
  }
}

void add(RenderResult& to, const RenderResult& run) {
  add(to.film, run.film);
  to.counts += run.counts;
  to.seconds += run.seconds;
  to.threads = run.threads;
}

/// A seed of its own for each round and half. Seeds are mixed before use, so neighbours are as good as any.
std::uint64_t seed_of(std::uint64_t seed, int round, int half) {
  constexpr std::uint64_t odd = 0xD1342543DE82EF95U;  // so that the user's seed 1 does not repeat rounds of seed 0
  return seed * odd + static_cast<std::uint64_t>(2 * round + half);
}

/// Samples per pixel of the next round of a half: as many as there are, so that an early cancellation finds whole pictures, but at most a
/// quarter of all, so that a late one loses little.
int next_round(int done, int all) { return std::min({std::max(done, 1), std::max(all / 4, 1), all - done}); }

}  // namespace

void share_proposals(std::span<Surface> reference, std::span<Surface> candidate, std::span<const std::uint32_t> slots) {
  for (const std::uint32_t slot : slots) {
    Surface& r = reference[slot];
    Surface& c = candidate[slot];
    const auto is_special = [](const Surface& s) { return s.transmits() || (s.flags() & sample_delta) != 0; };
    if (is_special(r) || is_special(c)) continue;
    const Proposal& source = r.proposal().material() != nullptr ? r.proposal() : c.proposal();
    Proposal shared;
    if (source.material() != nullptr) shared = Proposal(*source.material(), std::max(source.cosine_share(), least_cosine_share));
    r = r.with_proposal(shared);
    c = c.with_proposal(std::move(shared));
  }
}

PairedRender render_pair(const Scene& scene, std::span<const Surface> reference, std::span<const Surface> candidate,
                         const RenderOptions& options, const Progress& progress) {
  if (reference.size() != scene.materials.size() || candidate.size() != scene.materials.size()) {
    throw Error(ErrorCode::invalid_argument, "a comparison needs a surface for each of the scene's " +
                                                 std::to_string(scene.materials.size()) + " materials");
  }
  if (options.spp < 1) throw Error(ErrorCode::invalid_argument, "spp is " + std::to_string(options.spp) + ", allowed is at least 1");
  const int half_spp = options.spp / 2 + options.spp % 2;
  const FilmDescription& size = scene.description.film;
  const auto empty = [&] {
    RenderResult result;
    result.film = Film(size.width, size.height);
    return result;
  };
  // halves[h][0] is of the reference, halves[h][1] of the candidate
  std::array<std::array<RenderResult, 2>, 2> halves{std::array{empty(), empty()}, std::array{empty(), empty()}};
  PairedRender pair;
  int done = 0;
  for (int round = 0; done < half_spp; ++round) {
    std::array<std::array<RenderResult, 2>, 2> runs;
    RenderOptions o = options;
    o.seconds = 0;
    o.spp = next_round(done, half_spp);
    bool complete = true;
    for (int turn = 0; turn < 4 && complete; ++turn) {
      // the one that begins alternates
      const int half = turn / 2, which = (turn + round) % 2;
      o.seed = seed_of(options.seed, round, half);
      const double begin = (done + o.spp * turn / 4.0) / half_spp, share = o.spp / (4.0 * half_spp);
      const Progress part = [&](std::string_view stage, double of_run) { return !progress || progress(stage, begin + share * of_run); };
      // also here, because a short run ends before it reports
      complete = part("rendering", 0);
      if (!complete) break;
      RenderResult& run = runs[static_cast<std::size_t>(half)][static_cast<std::size_t>(which)];
      run = render_scene(scene, o, part, which == 0 ? reference : candidate);
      complete = run.complete;
    }
    if (!complete) break;
    for (std::size_t h = 0; h < 2; ++h) {
      for (std::size_t w = 0; w < 2; ++w) add(halves[h][w], runs[h][w]);
    }
    done += o.spp;
  }
  pair.spp = 2 * done;
  pair.complete = done == half_spp;
  if (pair.spp == 0) throw Error(ErrorCode::cancelled, "the comparison was cancelled before both pictures had a sample");
  pair.noise = {halves[0][0].film.image(), halves[1][0].film.image(), halves[0][1].film.image(), halves[1][1].film.image()};
  pair.reference_run = std::move(halves[0][0]);
  pair.candidate_run = std::move(halves[0][1]);
  add(pair.reference_run, halves[1][0]);
  add(pair.candidate_run, halves[1][1]);
  pair.reference_run.complete = pair.candidate_run.complete = pair.complete;
  pair.reference = pair.reference_run.film.image();
  pair.candidate = pair.candidate_run.film.image();
  return pair;
}

}  // namespace brdf::render
