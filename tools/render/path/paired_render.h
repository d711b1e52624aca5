// SPDX-License-Identifier: Apache-2.0
// Two renders of one scene that differ in some materials alone, by the same paths as far as the materials allow, so that noise
// cancels in their difference; and what is left of it, from two independent halves.
#pragma once

#include "image/noise_floor.h"
#include "path/render_scene.h"

#include <span>
#include <vector>

namespace brdf::render {

/// The pictures and their halves. Each half has spp / 2 samples per pixel.
struct PairedRender {
  Image reference, candidate;
  NoisePair noise;
  int spp = 0;  ///< of each whole picture
  RenderResult reference_run, candidate_run;  ///< counts and seconds of all samples together; the films are those of the wholes
  bool complete = false;  ///< false: it was cancelled, and the pictures hold the rounds that were finished
};

/// Gives each slot at which `reference` and `candidate` differ one proposal for both: that of the reference's material where it
/// has one, else the candidate's, in either case with a share of cosine, so that no direction in which only one of them reflects is
/// missed. Slots with a delta lobe or with transmission keep their own. The lists are as long as the scene's materials.
void share_proposals(std::span<Surface> reference, std::span<Surface> candidate, std::span<const std::uint32_t> slots);

/// Renders both in turns: reference and candidate of a half with the same seed, the halves with seeds that follow from
/// options.seed, in rounds, so that neither a cancellation nor a machine that grows slower favours one of them. An odd
/// options.spp is raised by one; options.seconds is not used. What is told of render_scene applies, and cancelling before the
/// first round is finished throws Error(cancelled).
PairedRender render_pair(const Scene& scene, std::span<const Surface> reference, std::span<const Surface> candidate,
                         const RenderOptions& options, const Progress& progress = {});

}  // namespace brdf::render
