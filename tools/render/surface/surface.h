// SPDX-License-Identifier: Apache-2.0
// What a scene's material slot holds: values as RGB, and how directions are drawn.
#pragma once

#include "surface/channels_to_rgb.h"
#include "surface/proposal.h"

#include <brdf/analytic.h>
#include <brdf/material.h>

#include <memory>

namespace brdf::render {

class MeasuredTable;

struct SurfaceSample {
  Vec3f wi{0};
  float pdf = 0;             ///< per solid angle; a discrete probability for a delta lobe; 0: nothing was drawn
  Vec3f weight{0};           ///< f |cos_i| / pdf
  float eta = 1;             ///< relative index along the path; 1 for reflection
  std::uint32_t flags = sample_none;
};

/// An evaluator and a proposal. Both can be exchanged: `with_proposal` makes two surfaces of different values follow the
/// same paths from the same random numbers, so that the noise of their pictures cancels in the difference.
///
/// Directions are local (z is the normal) and point away from the surface. Copies share what they hold. Every const member is
/// thread-safe, noexcept and never allocates, unless it says so.
class Surface {
 public:
  /// Black.
  Surface() = default;
  /// A material with at most 1024 channels, prepared for sampling.
  static Surface from_material(const Material& material);
  /// A perfect diffuser, the same as from_analytic of it and faster than a call of the library.
  static Surface from_albedo(const Vec3f& albedo);
  /// Throws Error(invalid_argument). The model has three channels.
  static Surface from_analytic(const AnalyticModel& model);
  static Surface from_table(std::shared_ptr<const MeasuredTable> table);

  /// f in 1/sr; 0 for delta lobes.
  Vec3f eval(const Vec3f& wi, const Vec3f& wo) const noexcept;
  /// The density of `sample`; 0 for delta lobes.
  float pdf(const Vec3f& wi, const Vec3f& wo) const noexcept;
  SurfaceSample sample(const Vec3f& wo, const Vec3f& u, TransportMode mode) const noexcept;

  /// Union of the SampleFlags that samples may have.
  std::uint32_t flags() const noexcept { return flags_; }
  /// Whether light passes through: then its sides differ.
  bool transmits() const noexcept { return (flags_ & sample_transmission) != 0; }
  /// Whether eval can be other than 0.
  bool has_values() const noexcept { return kind_ != Kind::black && (flags_ & sample_delta) == 0; }

  /// Whether turning about the normal may matter; what is known to look the same from all sides needs no tangent of the mesh.
  bool has_grain() const noexcept { return kind_ == Kind::material || kind_ == Kind::table || proposal_.material() != nullptr; }

  const Proposal& proposal() const noexcept { return proposal_; }
  /// The measured table that it evaluates; null for all others.
  const MeasuredTable* table() const noexcept { return table_.get(); }
  /// Delta lobes keep drawing their own directions.
  Surface with_proposal(Proposal proposal) const;

 private:
  enum class Kind : std::uint8_t { black, diffuse, material, table };

  Kind kind_ = Kind::black;
  bool draws_itself_ = false;       ///< samples and their weights come from the material in one call
  std::uint32_t flags_ = sample_none;
  Vec3f diffuse_{0};                ///< albedo / pi
  std::shared_ptr<const Material> material_;
  std::shared_ptr<const MeasuredTable> table_;
  ChannelsToRgb rgb_;
  Proposal proposal_;
};

}  // namespace brdf::render
