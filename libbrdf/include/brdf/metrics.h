// SPDX-License-Identifier: Apache-2.0
/// @file metrics.h
/// Error metrics, one implementation for the library, the command line, the benchmark and the tests.
/// docs/tradeoff.md states each with its formula.
#pragma once

#include <brdf/direction.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brdf {

struct MaterialProfile;

/// `profile` is ProfileError::rms, and exists only where there is a profile.
enum class Metric : std::uint8_t { log_mae, cbrt_rms, psnr_env, psnr_lights, albedo_error, profile };
const char* to_string(Metric m) noexcept;
std::optional<Metric> metric_from_string(std::string_view name) noexcept;

/// Wanted: metric at most `value` (errors) or at least `value` (PSNR, dB).
struct ErrorTarget {
  Metric metric = Metric::log_mae;
  double value = 0;
};

/// Bands by max(theta_i, theta_o): below 60, 60-75, 75-85 degrees, and 85-90 reported apart.
struct BandedError {
  double all = 0;  ///< below 85 degrees
  std::array<double, 4> band{};
  double p95 = 0, max = 0;  ///< of single pairs, mean over channels, below 85 degrees
};

/// Errors weighted by what a scene asked: with w_q the share of the contribution of query q's cell of the profile, spread evenly over
/// it, and F the mean reference f of that cell,
///   rms       = sqrt sum_q w_q mean_c (f'_qc - f_qc)^2 / (F max(f_qc, F/10))     the relative error of what the material contributes,
///               which within a cell is in proportion to f,
///   log_error = sum_q w_q mean_c |log(f'_qc + F/100) - log(f_qc + F/100)|.
/// NaN where there is no profile.
struct ProfileError {
  double rms = std::numeric_limits<double>::quiet_NaN();
  double log_error = std::numeric_limits<double>::quiet_NaN();
};

struct ErrorReport {
  BandedError log_mae;         ///< mean |log(1 + f cos_i) - log(1 + f' cos_i)|
  BandedError cbrt_rms;        ///< sqrt mean (cbrt(f cos_i) - cbrt(f' cos_i))^2; p95 and max of the absolute difference
  double cos_l2 = 0;           ///< sqrt mean (f cos_i - f' cos_i)^2
  double psnr_env = 0;         ///< dB, at most 60
  double psnr_lights = 0;      ///< dB, mean of four directional lights, each at most 60
  std::array<double, 4> psnr_light{};  ///< front, deg45, grazing, top; at most 60 each
  double albedo_error = 0;     ///< largest |albedo - albedo'| over channels at cos_o .95 .8 .6 .4 .2
  ProfileError profile;        ///< filled in by ProfileComparison::score, not by Comparison::score
  std::uint64_t not_finite = 0, negative = 0;  ///< rows of the candidate, those of the albedo included
  double get(Metric m) const noexcept;
  /// True when `t` is met.
  bool meets(const ErrorTarget& t) const noexcept;
};

/// Evaluates rows: values of channel c of row i at out[i * channels + c]. Called from several threads at once when a
/// comparison has more than one.
using BatchEval = std::function<void(std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out)>;

/// The fixed queries of all metrics and what a reference answers at them. Building one takes the time of about a million
/// evaluations of the reference (`quality` 1); smaller qualities use fewer pixels, lights and pairs.
/// Immutable after construction and thread-safe.
class Comparison {
 public:
  /// `channels` values per row. quality in (0, 1].
  Comparison(const BatchEval& reference, int channels, double quality = 1.0, int threads = 1);
  ~Comparison();
  Comparison(Comparison&&) noexcept;
  Comparison& operator=(Comparison&&) noexcept;

  /// Scores a candidate with the same number of channels.
  ErrorReport score(const BatchEval& candidate) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Scores candidates at what a scene asked: up to eight pairs of directions in every cell of the profile that has a
/// contribution. Immutable after construction, thread-safe, cheap to copy.
class ProfileComparison {
 public:
  /// Rows for which the reference answers NaN were not measured and do not count. Throws Error(no_data) when no reflection above
  /// the horizon contributes, or none that was measured.
  ProfileComparison(const BatchEval& reference, int channels, const MaterialProfile& asked);
  ProfileError score(const BatchEval& candidate) const;
  std::size_t size() const noexcept;  ///< pairs of directions

 private:
  struct State;
  static void leave_out_unmeasured(State& s);
  std::shared_ptr<const State> state_;
};

}  // namespace brdf
