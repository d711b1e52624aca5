// SPDX-License-Identifier: Apache-2.0
/// @file material.h
/// What a renderer holds: an immutable, thread-safe handle, cheap to copy.
#pragma once

#include <brdf/analytic.h>
#include <brdf/direction.h>
#include <brdf/limits.h>
#include <brdf/lobes.h>
#include <brdf/measurement.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace brdf {

/// The evaluation knob. One file serves all three.
enum class EvalLevel : std::uint8_t {
  fast = 0,      ///< lobes only
  balanced = 1,  ///< lobes and a residual grid that lives in the processor's inner caches
  exact = 2,     ///< lobes and the full residual grid; of a file in slices, the slices themselves
};
const char* to_string(EvalLevel level) noexcept;

/// What travels along a path; decides about eta squared in transmission.
enum class TransportMode : std::uint8_t { radiance, importance };

/// Bits of Sample::flags; 0 means that no direction was found.
enum SampleFlags : std::uint32_t { sample_none = 0, sample_reflection = 1, sample_transmission = 2, sample_delta = 4 };

struct Sample {
  Vec3f wi{0, 0, 0};            ///< unit vector towards the light
  float pdf = 0;                ///< density per solid angle of wi; a discrete probability for a delta lobe; 0: rejected
  float eta = 1;                ///< relative index of refraction along the path; 1 for reflection
  std::uint32_t flags = sample_none;
};

struct DecodeOptions {
  DecodeLimits limits;
  bool allow_prefix = false;              ///< accept a file cut at a refinement boundary
  EvalLevel level = EvalLevel::balanced;  ///< prepared for this level
  bool sampling = true;                   ///< prepared for sampling, too
};

/// Recorded error of a refinement at a level, as measured by the encoder against its source.
struct RecordedError {
  int refinement = 0;  ///< 0 = lobes only
  EvalLevel level = EvalLevel::balanced;
  double log_mae = 0;
  double psnr_env = 0;  ///< dB
};

/// What a file says about itself.
struct MaterialInfo {
  int format_version = 1;
  std::uint64_t bytes = 0;         ///< bytes given
  std::uint64_t total_bytes = 0;   ///< bytes of the whole file
  int refinements_read = 0, refinements_total = 0;  ///< "k of n", lobes not counted
  Channels channels;
  bool reciprocal = false;         ///< exactly f(wi, wo) = f(wo, wi)
  bool mirror_symmetric = true;
  std::vector<RecordedError> errors;
  Provenance provenance;           ///< empty strings where the file carries none
  std::string fitter;              ///< version that wrote it
};

/// An isotropic or anisotropic reflector, ready to evaluate, sample and integrate.
///
/// Every const member is thread-safe. Evaluation, sampling and pdf are noexcept and never allocate or lock. f is in
/// 1/sr, without the cosine; 0 with either direction at or below the horizon. Spans of values hold `channels()` floats.
class Material {
 public:
  /// Reads a `.brdfc` file. Throws Error: not_recognized, malformed, truncated, checksum, limit_exceeded, unsupported.
  static Material decode(std::span<const std::byte> bytes, const DecodeOptions& options = {});

  /// A material of analytic lobes alone. Throws Error(invalid_argument).
  static Material from_lobes(const LobeSet& lobes);

  /// A material of a formula. It needs no tables: every level is the same, it is always ready to be sampled, and info()
  /// tells of no refinements and no errors. lobes() holds the equal lobe of a Lambertian and of an isotropic GGX reflector
  /// without multiple scattering, and none for the others. Three channels are RGB, one is a scalar, others are spectral
  /// without wavelengths. Throws Error(invalid_argument).
  static Material from_analytic(const AnalyticModel& model);

  /// A new handle with the tables of `level` built. May allocate and throw Error(limit_exceeded).
  Material prepare(EvalLevel level, bool sampling) const;
  /// The same, for sampling if this one is.
  Material prepare(EvalLevel level) const;

  int channels() const noexcept;
  EvalLevel level() const noexcept;
  const MaterialInfo& info() const noexcept;
  const LobeSet& lobes() const noexcept;
  const AnalyticModel* analytic() const noexcept;  ///< the formula of an analytic material; null for others
  /// Union of the flags that samples can carry: sample_reflection for what was measured. With sample_delta, samples are delta
  /// ones, eval and pdf are 0. With sample_transmission both sides scatter, and wi may be on the other side than wo.
  std::uint32_t scatter_flags() const noexcept;
  bool sampling() const noexcept;                 ///< prepared for sampling
  std::uint64_t resident_bytes() const noexcept;  ///< of the tables that evaluation touches
  std::uint64_t sampling_bytes() const noexcept;  ///< of the tables that sample and pdf touch beside them; 0 without

  void eval(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept;
  /// Density of `sample` at wi given wo, per solid angle of wi. A material that is not prepared for sampling draws
  /// cosine-distributed directions, and this is their density.
  float pdf(const Vec3f& wi, const Vec3f& wo) const noexcept;
  float eval_pdf(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept;
  /// Draws wi given wo. u in [0,1)^3: (u.y, u.z) are warped, continuously and piecewise invertibly, to the directions above
  /// the horizon; u.x chooses the component of the mixture that is warped to: one of the two tabulated views around wo and,
  /// of a material that has them, the retro lobes. pdf is that of the whole mixture. `weight` = f cos_i / pdf per channel.
  /// Nothing is rejected: only with wo at or below the horizon pdf is 0, weight 0 and no flag set.
  ///
  /// Analytic materials: a GGX reflector is drawn by its visible normals and, with multiple scattering, by the cosine, with
  /// u.x for the choice. A delta lobe needs no (u.y, u.z); u.x chooses between reflection and transmission, pdf is the
  /// probability of the choice, weight = f cos_i / pdf is what the light is multiplied by. A transmitting material takes wo below
  /// the surface, too; with wo exactly in it pdf is 0. eta is the index of refraction on wi's side over that on wo's. In `mode`
  /// radiance the weight of a transmission holds 1 / eta^2, in `mode` importance it does not (Veach 1997, sec. 5.2).
  Sample sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight,
                TransportMode mode = TransportMode::radiance) const noexcept;
  /// Directional albedo: integral of f cos_i over wi, by deterministic quadrature: the mean of the weights of 9216 samples
  /// (about 1e-3 relative where the material is prepared for sampling; without, narrow lobes are missed). Of delta lobes the
  /// closed form: the share of the power that goes on, without factors of eta.
  void albedo(const Vec3f& wo, std::span<float> a) const noexcept;

  /// Batches: any size, any alignment, in place not allowed. The instruction set is chosen at run time.
  void eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept;
  void pdf(DirectionSpan wi, DirectionSpan wo, float* pdf) const noexcept;
  void eval_pdf(DirectionSpan wi, DirectionSpan wo, PlanarSpan f, float* pdf) const noexcept;
  /// u as three planes in a DirectionSpan; writes wi, pdf and weight. Flags and eta follow: scatter_flags() tells of delta
  /// lobes, and what changes sides (wi.z wo.z < 0) was transmitted.
  void sample(DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf, PlanarSpan weight,
              TransportMode mode = TransportMode::radiance) const noexcept;

  struct Impl;
  struct Sampling;
  explicit Material(std::shared_ptr<const Impl> impl, std::shared_ptr<const Sampling> sampling = nullptr) noexcept
      : impl_(std::move(impl)), sampling_(std::move(sampling)) {}

 private:
  std::shared_ptr<const Impl> impl_;
  std::shared_ptr<const Sampling> sampling_;
};

/// Lengths at which a `.brdfc` file may be cut: after the lobes and after each refinement. The header alone must be there.
/// Throws like Material::decode.
std::vector<std::uint64_t> refinement_boundaries(std::span<const std::byte> bytes, const DecodeLimits& limits = {});

/// Name of the instruction set that batches use now: "scalar", "SSE4", "AVX2", "AVX3" (AVX-512) and so on.
const char* simd_target() noexcept;

}  // namespace brdf
