// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"
#include "image/display.h"
#include "image/flip_colour.h"

#include <glm/common.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace brdf::render {
namespace {

using Planes = std::array<Plane, 3>;

constexpr double pi = 3.14159265358979323846;

Planes opponent_planes(const Image& image) {
  Planes planes{Plane(image.width, image.height), Plane(image.width, image.height), Plane(image.width, image.height)};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Vec3d value = opponent_from_linear(Vec3d(image.pixels[i]));
    for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)].values[i] = static_cast<float>(value[c]);
  }
  return planes;
}

/// A term a sqrt(pi / b) exp(-pi^2 x^2 / b) of a contrast sensitivity function in space, x in degrees (section 4.1, table 1).
struct Gaussian {
  double a, b;
};
constexpr Gaussian achromatic{1, 0.0047}, red_green{1, 0.0053};
constexpr std::array<Gaussian, 2> blue_yellow{Gaussian{34.1, 0.04}, Gaussian{13.5, 0.025}};

/// The sum of Gaussians in two dimensions, normalised to 1. Each term is a product of two kernels in one dimension; the
/// normalisation joins the first of them.
Plane sensed(const Plane& plane, std::span<const Gaussian> terms, double pixels_per_degree) {
  // section 4.1: three standard deviations of the widest Gaussian of all, for every channel
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(blue_yellow[0].b / (2 * pi * pi)) * pixels_per_degree));
  std::vector<std::vector<double>> profiles;
  double total = 0;
  for (const auto& [a, b] : terms) {
    std::vector<double> profile;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) {
      const double x = i / pixels_per_degree;
      sum += profile.emplace_back(std::exp(-pi * pi * x * x / b));
    }
    profiles.push_back(std::move(profile));
    total += a * std::sqrt(pi / b) * sum * sum;
  }
  Plane result(plane.width, plane.height);
  for (std::size_t term = 0; term < terms.size(); ++term) {
    const double weight = terms[term].a * std::sqrt(pi / terms[term].b) / total;
    std::vector<float> vertical(profiles[term].begin(), profiles[term].end()), horizontal;
    for (const double value : profiles[term]) horizontal.push_back(static_cast<float>(weight * value));
    const Plane part = filtered(plane, horizontal, vertical);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += part.values[i];
  }
  return result;
}

/// What the eye resolves of a picture, in the perceptually uniform space.
std::vector<Vec3d> perceived(const Planes& opponent, double pixels_per_degree) {
  const Plane y = sensed(opponent[0], std::span(&achromatic, 1), pixels_per_degree);
  const Plane x = sensed(opponent[1], std::span(&red_green, 1), pixels_per_degree);
  const Plane z = sensed(opponent[2], blue_yellow, pixels_per_degree);
  std::vector<Vec3d> result;
  result.reserve(y.values.size());
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const Vec3d rgb = linear_from_opponent(Vec3d(y.values[i], x.values[i], z.values[i]));
    result.push_back(hunt_lab_from_linear(glm::clamp(rgb, Vec3d(0), Vec3d(1))));
  }
  return result;
}

/// The colour difference in [0, 1]: HyAB to the power q_c, then the lower p_c of its range spread over p_t (section 4.1.2).
double colour_difference(const Vec3d& a, const Vec3d& b) {
  constexpr double q_c = 0.7, p_c = 0.4, p_t = 0.95;
  static const double largest =
      std::pow(hyab(hunt_lab_from_linear(Vec3d(0, 1, 0)), hunt_lab_from_linear(Vec3d(0, 0, 1))), q_c);
  const double difference = std::pow(hyab(a, b), q_c), knee = p_c * largest;
  if (difference < knee) return p_t / knee * difference;
  return std::min(1.0, p_t + (difference - knee) / (largest - knee) * (1 - p_t));
}

/// Kernels of section 4.2: a Gaussian and its derivatives, the positive and the negative weights each of sum 1.
struct FeatureKernels {
  std::vector<float> gaussian, edge, point;
};

std::vector<float> balanced(const std::vector<double>& weights) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
  std::vector<float> result;
  for (const double w : weights) result.push_back(static_cast<float>(w > 0 ? w / positive : w == 0 ? 0 : w / negative));
  return result;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
  constexpr double feature_width = 0.082;  // degrees
  const double deviation = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> gaussian, edge, point;
  for (int i = -radius; i <= radius; ++i) {
    const double x = i / deviation, g = std::exp(-x * x / 2);
    gaussian.push_back(g);
    edge.push_back(-x * g);
    point.push_back((x * x - 1) * g);
  }
  return {balanced(gaussian), balanced(edge), balanced(point)};
}

/// Lengths of the gradient (edges) and of the second derivatives (points) of the achromatic channel.
struct Features {
  Plane edges, points;
};

Plane length_of(const Plane& x, const Plane& y) {
  Plane result(x.width, x.height);
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = std::hypot(x.values[i], y.values[i]);
  return result;
}

Features features_of(const Plane& achromatic_plane, const FeatureKernels& kernels) {
  Plane y = achromatic_plane;
  for (float& value : y.values) value = (value + 16) / 116;  // to [0, 1]
  return {length_of(filtered(y, kernels.edge, kernels.gaussian), filtered(y, kernels.gaussian, kernels.edge)),
          length_of(filtered(y, kernels.point, kernels.gaussian), filtered(y, kernels.gaussian, kernels.point))};
}

}  // namespace

Plane flip(const Image& reference, const Image& candidate, double pixels_per_degree) {
  check_same_size(reference, candidate);
  const FeatureKernels kernels = feature_kernels(pixels_per_degree);
  const Planes a = opponent_planes(exposed(reference, 0)), b = opponent_planes(exposed(candidate, 0));
  const std::vector<Vec3d> seen_a = perceived(a, pixels_per_degree), seen_b = perceived(b, pixels_per_degree);
  const Features features_a = features_of(a[0], kernels), features_b = features_of(b[0], kernels);
  Plane map(reference.width, reference.height);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const double edges = std::abs(static_cast<double>(features_a.edges.values[i]) - static_cast<double>(features_b.edges.values[i]));
    const double points = std::abs(static_cast<double>(features_a.points.values[i]) - static_cast<double>(features_b.points.values[i]));
    const double feature_difference = std::min(1.0, std::sqrt(std::max(edges, points) / std::sqrt(2.0)));  // q_f = 0.5
    map.values[i] = static_cast<float>(std::pow(colour_difference(seen_a[i], seen_b[i]), 1 - feature_difference));
  }
  return map;
}

}  // namespace brdf::render
