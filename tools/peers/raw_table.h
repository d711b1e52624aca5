// SPDX-License-Identifier: Apache-2.0
// The measured table itself as a renderer would hold it: float RGB, read by the fastest trilinear look-up we know. It is
// what a compressed material's speed is compared with.
#pragma once

#include <brdf/direction.h>
#include <brdf/measurement.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace brdf::peers {

/// What the kernels read. Texels are three adjacent floats; each row of phi_d ends with its first texel once more, so that
/// both ends of every step along phi_d are one run of six floats.
struct RawTableView {
  const float* texels = nullptr;
  std::int32_t n_h = 0, n_d = 0, n_p = 0;
  std::int32_t step_d = 0, step_h = 0;  ///< floats from one bin to the next
  float offset = 0;                     ///< of a sample within its bin
  bool full_circle = false;
};

/// Linear in bin coordinates like MeasurementInterpolator, in float. Cells without a measurement are filled beforehand with
/// the mean of their neighbours instead of being left out at each look-up, so values differ where a corner is missing.
class RawTable {
 public:
  /// Copies `table`. Throws Error(invalid_argument) unless it has three channels and sizes that agree.
  explicit RawTable(const HalfDifferenceTable& table);

  /// f(wi, wo) in 1/sr, three planes; 0 below the horizon. On the best instruction set of the machine.
  void eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept;
  /// One pair in plain C++.
  void eval(const Vec3f& wi, const Vec3f& wo, std::span<float, 3> f) const noexcept;

  std::uint64_t resident_bytes() const noexcept { return bytes_; }

 private:
  struct Free {
    void operator()(float* p) const noexcept;
  };
  std::unique_ptr<float[], Free> texels_;
  std::uint64_t bytes_ = 0;
  RawTableView view_;
};

/// A 90 x 90 x 180 table of the interpolated values of `m`, which has three channels: what a measurement in another
/// parametrisation is when it is held in MERL's.
HalfDifferenceTable resample_to_merl(const Measurement& m);

}  // namespace brdf::peers
