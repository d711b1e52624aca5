// SPDX-License-Identifier: Apache-2.0
// Tables of a few thousand cells whose values follow a formula.
#pragma once

#include "geometry/half_difference.h"

#include <brdf/lobes.h>
#include <brdf/measurement.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace brdf::test {

struct TableShape {
  int n_theta_h = 36, n_theta_d = 18, n_phi_d = 24;
  bool full_circle = false;
};

/// value(wi, wo, f) fills f with one value per channel. Cells below the horizon are invalid.
template <class Value>
Measurement small_measurement(const TableShape& shape, int channels, Value&& value) {
  Measurement m;
  m.channels.count = channels;
  if (channels == 1) m.channels.model = ChannelModel::scalar;
  if (channels != 1 && channels != 3) {
    m.channels.model = ChannelModel::spectral;
    for (int c = 0; c < channels; ++c)
      m.channels.wavelengths_nm.push_back(static_cast<float>(400 + 300 * c / channels));
  }
  m.provenance = {"formula", "MERL", "values of a formula", "CC0", 42, 1234};
  HalfDifferenceTable t;
  t.n_theta_h = shape.n_theta_h;
  t.n_theta_d = shape.n_theta_d;
  t.n_phi_d = shape.n_phi_d;
  t.full_circle = shape.full_circle;
  std::vector<double> f(static_cast<std::size_t>(channels));
  const double pi = std::numbers::pi;
  for (int i = 0; i < t.n_theta_h; ++i)
    for (int j = 0; j < t.n_theta_d; ++j)
      for (int k = 0; k < t.n_phi_d; ++k) {
        const double u = static_cast<double>(i) / t.n_theta_h;
        Vec3d wi, wo;
        geometry::directions_from_half_difference(u * u * pi / 2, j * pi / 2 / t.n_theta_d,
                                                  k * (t.full_circle ? 2 * pi : pi) / t.n_phi_d, wi, wo);
        const bool above = wi.z > 1e-9 && wo.z > 1e-9;
        t.valid.push_back(above ? 1 : 0);
        if (above) value(wi, wo, std::span<double>(f));
        for (const double v : f) t.values.push_back(above ? static_cast<float>(v) : -1.0F);
      }
  m.table = std::move(t);
  return m;
}

inline Measurement lobes_measurement(const LobeSet& lobes, const TableShape& shape = {}) {
  return small_measurement(shape, lobes.channels, [&](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    eval_lobes(lobes, wi, wo, f);
  });
}

/// Diffuse and glossy, with bumps that no lobe has. Reciprocal unless the table covers the full circle and `tilt` is not 0.
inline Measurement bumpy_measurement(const TableShape& shape = {}, int channels = 3, double tilt = 0) {
  const auto color = [channels](double first) {
    std::vector<double> c;
    for (int i = 0; i < channels; ++i) c.push_back(first * (1 - 0.4 * i / channels));
    return c;
  };
  const LobeSet lobes{channels, {{LobeKind::lambert, 1, 1, color(0.25)}, {LobeKind::ggx, 0.2, 0.9, color(0.08)}}};
  return small_measurement(shape, channels, [&](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    eval_lobes(lobes, wi, wo, f);
    const auto hd = geometry::half_difference(wi, wo);
    const double bumps =
        1 + 0.3 * std::cos(9 * hd.sin_theta_h) * hd.cos_theta_d + 0.2 * hd.sin_theta_d * hd.sin_theta_d;
    const double slant = 1 + tilt * hd.cos_phi_d * hd.sin_theta_h * hd.sin_theta_d;
    for (std::size_t c = 0; c < f.size(); ++c)
      f[c] *= bumps * slant * (1 + 0.05 * static_cast<double>(c) * hd.sin_theta_h);
  });
}

}  // namespace brdf::test
