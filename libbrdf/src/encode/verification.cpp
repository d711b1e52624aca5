// SPDX-License-Identifier: Apache-2.0
#include "encode/verification.h"

#include "encode/query_weight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace brdf::encode {
namespace {

/// `unmeasured` where the measurement has no value.
BatchEval reference_rows(const MeasurementInterpolator& reference, int channels, float unmeasured) {
  return [&reference, channels, unmeasured](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    const auto n = static_cast<std::size_t>(channels);
    std::vector<double> f(n);
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const bool measured = reference.eval(Vec3d(wi[i]), Vec3d(wo[i]), f);
      for (std::size_t c = 0; c < n; ++c) out[i * n + c] = measured ? static_cast<float>(f[c]) : unmeasured;
    }
  };
}

}  // namespace

Verification::Verification(const Measurement& m, double quality, int threads, const MaterialProfile* asked)
    : reference_(m), comparison_(reference_rows(reference_, m.channels.count, 0), m.channels.count, quality, threads) {
  if (asked != nullptr) asked_.emplace(reference_rows(reference_, m.channels.count, std::numeric_limits<float>::quiet_NaN()), m.channels.count, *asked);
}

ErrorReport Verification::score(const Material& material) const {
  const auto n = static_cast<std::size_t>(material.channels());
  const BatchEval eval = [&material, n](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i) material.eval(wi[i], wo[i], out.subspan(i * n, n));
  };
  ErrorReport report = comparison_.score(eval);
  if (asked_) report.profile = asked_->score(eval);
  return report;
}

ErrorReport Verification::score(std::span<const std::byte> bytes, EvalLevel level) const {
  DecodeOptions decode;
  decode.sampling = false;
  decode.level = level;
  decode.allow_prefix = true;
  return score(Material::decode(bytes, decode));
}

double merit(const ErrorReport& r) noexcept {
  const double usual = (r.psnr_env + r.psnr_lights - 20 * std::log10(std::max(r.log_mae.all, 1e-9))) / 3;
  if (std::isnan(r.profile.rms)) return usual;
  // the logarithm, which pictures follow best, and for a third the rms, in which a few bright pairs may decide
  const auto decibels = [](double error) { return -20 * std::log10(std::max(error, 1e-9)); };
  return (1 - asked_share) * usual + asked_share * (decibels(r.profile.rms) + 2 * decibels(r.profile.log_error)) / 3;
}

}  // namespace brdf::encode
