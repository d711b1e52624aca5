// SPDX-License-Identifier: Apache-2.0
// A measurement in the layout of the RGL database whose values follow a formula.
#pragma once

#include <brdf/measurement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace brdf::test {

struct SliceShape {
  int slices = 6, size = 16, ndf_nodes = 48, rows = 32;
  double alpha = 0.2;
};

/// GGX normals; the values vary smoothly with every coordinate and from channel to channel, the same on both sides.
inline Measurement slice_measurement(const SliceShape& shape = {}) {
  constexpr double pi = std::numbers::pi;
  Measurement m;
  m.channels.count = 3;
  m.provenance = {"slices", "RGL", "values of a formula", "CC0", 7, 4321};
  VisibleNormalTable t;
  for (int s = 0; s < shape.slices; ++s) t.theta_i.push_back(static_cast<float>(pi / 2 * std::sqrt(static_cast<double>(s) / (shape.slices - 1))));
  t.ndf_height = 2;
  t.ndf_width = shape.ndf_nodes;
  const auto elevation = [&](int x, int n) { return std::pow(static_cast<double>(x) / (n - 1), 2) * pi / 2; };
  const auto ndf = [&](double theta) {
    const double c2 = std::pow(std::cos(theta), 2), a2 = shape.alpha * shape.alpha;
    return a2 / (pi * std::pow(c2 * (a2 - 1) + 1, 2)) * std::cos(theta);
  };
  for (int row = 0; row < 2; ++row)
    for (int x = 0; x < shape.ndf_nodes; ++x) t.ndf.push_back(static_cast<float>(ndf(elevation(x, shape.ndf_nodes))));
  t.sigma_height = 2;
  t.sigma_width = 65;
  for (int row = 0; row < 2; ++row)
    for (int x = 0; x < 65; ++x) {
      const double theta_i = elevation(x, 65);
      double sum = 0;
      for (int k = 0; k < 400; ++k)
        for (int p = 0; p < 64; ++p) {
          const double u = (k + 0.5) / 400, theta = u * u * pi / 2, phi = (p + 0.5) / 64 * 2 * pi;
          const double cosine = std::cos(theta_i) * std::cos(theta) + std::sin(theta_i) * std::sin(theta) * std::cos(phi);
          sum += ndf(theta) * std::max(cosine, 0.0) * std::sin(theta) * pi * u / 400 * 2 * pi / 64;
        }
      t.sigma.push_back(static_cast<float>(sum));
    }
  const float top = t.sigma[0];
  for (float& s : t.sigma) s /= top;
  t.vndf_height = shape.rows;
  t.vndf_width = shape.ndf_nodes;
  for (const float slice : t.theta_i)
    for (int r = 0; r < shape.rows; ++r)
      for (int x = 0; x < shape.ndf_nodes; ++x) {
        const double theta_i = static_cast<double>(slice), phi = (2.0 * r / (shape.rows - 1) - 1) * pi, theta = elevation(x, shape.ndf_nodes);
        const double cosine = std::cos(theta_i) * std::cos(theta) + std::sin(theta_i) * std::sin(theta) * std::cos(phi);
        t.vndf.push_back(static_cast<float>(static_cast<double>(t.ndf[static_cast<std::size_t>(x)]) * std::max(cosine, 0.0) * std::sin(theta) * x / (shape.ndf_nodes - 1)));
      }
  t.height = t.width = shape.size;
  for (int s = 0; s < shape.slices; ++s)
    for (int y = 0; y < shape.size; ++y)
      for (int x = 0; x < shape.size; ++x)
        for (int c = 0; c < 3; ++c) {
          const double u = static_cast<double>(x) / (shape.size - 1), v = std::fabs(2.0 * y / (shape.size - 1) - 1);
          t.values.push_back(static_cast<float>((0.5 + 0.1 * c) * std::exp(0.6 * std::cos(3 * u + c) + 0.4 * std::cos(pi * v) * u + 0.3 * s / shape.slices)));
        }
  m.table = std::move(t);
  return m;
}

}  // namespace brdf::test
