// SPDX-License-Identifier: Apache-2.0
/// @file profile.h
/// What a scene asked of its materials: recorded by a renderer, written to a small file, read by the encoder.
///
/// A profile is made of integers: sums of contributions are fixed-point numbers that stop at the largest one instead of
/// wrapping around. Merging is therefore exact, and neither its order nor the number of threads has an effect.
/// docs/profile_format.md describes the file.
#pragma once

#include <brdf/direction.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brdf {

/// What can be asked of a material. `transmission` counts queries, of either kind, that join both sides of the surface.
enum class ProfileOperation : std::uint8_t { eval = 0, sample = 1, pdf = 2, transmission = 3 };
inline constexpr int profile_operations = 4;
const char* to_string(ProfileOperation operation) noexcept;

/// Cells of the histogram, in half/difference coordinates. With chord(theta) = sqrt(2) sin(theta / 2), 0 to 1 from the pole to
/// 90 degrees, bins are even in
///   sqrt(chord(theta_h))    so that the first bin is 0.035 degrees wide,
///   chord(theta_d),
///   u_p(|phi_d|)            which is sin(phi_d / 2) / sqrt(2) up to 90 degrees and 1 - u_p(180 degrees - phi_d) beyond.
/// Cell index = phi_d bin + 12 * (theta_d bin + 24 * theta_h bin). Marginals are even in their angle.
struct ProfileGrid {
  static constexpr int theta_h = 48, theta_d = 24, phi_d = 12;
  static constexpr int cells = theta_h * theta_d * phi_d;
  static constexpr int phi_h = 16;   ///< of the circle, from the tangent on
  static constexpr int theta = 18;   ///< 5 degrees each
  /// Lower edges of the bins, radians; `i` may be the number of bins.
  static double theta_h_edge(int i) noexcept;
  static double theta_d_edge(int i) noexcept;
  static double phi_d_edge(int i) noexcept;
};

/// Where a pair of directions lies in a profile: worked out once, used for every contribution that passes through.
struct ProfilePlace {
  std::uint32_t cell = ProfileGrid::cells;  ///< `cells`: not a reflection above the surface
  std::uint8_t phi_h = 0, theta_i_bin = 0, theta_o_bin = 0;
  bool transmission = false;
  float theta_i = 0, theta_o = 0;           ///< radians, to 10^-4
};

/// Unit vectors away from the surface, of either side. Pairs below it on both sides, and what is no number, have no cell.
ProfilePlace profile_place(const Vec3f& wi, const Vec3f& wo) noexcept;

/// Smallest and largest of the angles that were asked; radians.
struct ProfileRange {
  float least = 2, most = -1;  ///< least > most: none
  bool operator==(const ProfileRange&) const = default;
};

/// What was asked of one material. Plain data: sums over everything that was recorded.
struct MaterialProfile {
  /// A contribution of 1 is this many units. Choose what a renderer calls 1 near white: below 2 * 10^-9 nothing counts, a single
  /// contribution counts as at most `largest_contribution`, and sums stop at about 7 * 10^10.
  static constexpr double units = 268435456.0;  // 2^28
  static constexpr double largest_contribution = 16777216.0;
  static constexpr double pixel_units = 16777216.0;  ///< units of one pixel of footprint, 2^24

  std::array<std::uint64_t, profile_operations> operations{};  ///< numbers of queries
  std::uint64_t contributions = 0;                 ///< how many contributions were above 0
  std::vector<std::uint64_t> histogram;            ///< of contribution, ProfileGrid::cells entries
  std::array<std::uint64_t, ProfileGrid::phi_h> phi_h{};
  std::array<std::uint64_t, ProfileGrid::theta> theta_i{}, theta_o{};
  ProfileRange range_i, range_o;                   ///< of reflections with a contribution
  std::uint64_t transmitted = 0;                   ///< contribution through the surface; in no histogram
  std::uint64_t footprint = 0;                     ///< pixels that see the material first
  std::uint64_t first_hits = 0;                    ///< camera rays that see it first

  MaterialProfile();

  void add(const ProfilePlace& place, double contribution) noexcept;
  void merge(const MaterialProfile& other) noexcept;

  double contribution() const noexcept;            ///< sum of the histogram, in the renderer's units
  double footprint_pixels() const noexcept { return static_cast<double>(footprint) / pixel_units; }
  bool asked(ProfileOperation o) const noexcept { return operations[static_cast<std::size_t>(o)] > 0; }
  bool operator==(const MaterialProfile&) const = default;
};

/// Limits for reading profiles of strangers. A material takes 0.11 MB once read.
struct ProfileLimits {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 26;
  std::uint32_t max_materials = 1024;
  std::uint32_t max_name_bytes = 255;
};

/// What a scene asked, by the name of the material's slot.
struct Profile {
  std::map<std::string, MaterialProfile, std::less<>> materials;

  /// Adds another rendering of the same or other slots; commutative and associative.
  void merge(const Profile& other);
  /// Share of the whole contribution, reflected or transmitted, that passed through a slot: 0 to 1; 0 without any.
  double share(std::string_view slot) const noexcept;
  /// Throws Error(invalid_argument) with the names there are.
  const MaterialProfile& at(std::string_view slot) const&;
  MaterialProfile at(std::string_view slot) && { return static_cast<const Profile&>(*this).at(slot); }

  /// Bytes of a profile file. Throws Error(invalid_argument): no name, or one longer than 255 bytes or with control characters.
  std::vector<std::byte> write() const;
  /// Throws Error: not_recognized, malformed, truncated, checksum, limit_exceeded, unsupported.
  static Profile read(std::span<const std::byte> bytes, const ProfileLimits& limits = {});

  bool operator==(const Profile&) const = default;
};

/// What a renderer calls. One recorder per thread: recording is noexcept, never allocates or locks, and takes some tens of
/// nanoseconds; `merge` joins the threads in the end. Slots are indices into the names given at construction, and a slot
/// that is none is ignored. A slot takes 0.11 MB.
///
/// A path tracer counts each query, keeps the place of every vertex of a path and, whenever light reaches the camera along
/// the path, adds that contribution (luminance of throughput times f cos theta times incoming radiance over the density, as
/// it enters the sum of a pixel) to each of them:
///
///     recorder.count(slot, ProfileOperation::sample);
///     vertex[k] = {slot, profile_place(wi, wo)};
///     ...
///     for (v : vertices so far) recorder.add(v.slot, v.place, luminance(contribution));
class ProfileRecorder {
 public:
  explicit ProfileRecorder(std::vector<std::string> slots);

  void count(std::size_t slot, ProfileOperation operation, std::uint64_t number = 1) noexcept {
    if (slot < materials_.size()) materials_[slot].operations[static_cast<std::size_t>(operation)] += number;
  }
  /// Contributions that are not above 0 are ignored.
  void add(std::size_t slot, const ProfilePlace& place, double contribution) noexcept {
    if (slot < materials_.size()) materials_[slot].add(place, contribution);
  }
  /// Counts and adds at once.
  void record(std::size_t slot, ProfileOperation operation, const Vec3f& wi, const Vec3f& wo, double contribution) noexcept;
  /// A camera ray, which stands for `pixels` of the image (1 / samples per pixel), sees this material first.
  void first_hit(std::size_t slot, double pixels) noexcept;

  /// Adds what another thread recorded. Throws Error(invalid_argument) when its slots have other names.
  void merge(const ProfileRecorder& other);
  const std::vector<std::string>& slots() const noexcept { return slots_; }
  /// Slots of the same name are one material.
  Profile profile() const;

 private:
  std::vector<std::string> slots_;
  std::vector<MaterialProfile> materials_;
};

}  // namespace brdf
