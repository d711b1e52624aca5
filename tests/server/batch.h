// SPDX-License-Identifier: Apache-2.0
// Batches of queries, and what goes with them.
#pragma once

#include "server/daemon_fixture.h"
#include "shared/float_bytes.h"

#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace brdf::test {

/// Planes of unit vectors, some of them below the horizon.
inline std::vector<float> directions(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> planes(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const float x = normal(random), y = normal(random), z = normal(random) + 1, length = std::sqrt(x * x + y * y + z * z);
    planes[i] = x / length;
    planes[n + i] = y / length;
    planes[2 * n + i] = z / length;
  }
  return planes;
}

inline std::string bytes_of(std::span<const float> values) {
  std::string bytes(values.size_bytes(), '\0');
  service::store_floats(values, bytes, 0);
  return bytes;
}

inline std::vector<float> floats_of(const std::string& bytes) {
  std::vector<float> values(bytes.size() / sizeof(float));
  service::load_floats(bytes, 0, values);
  return values;
}

inline DirectionSpan span_of(const std::vector<float>& planes) {
  const std::size_t n = planes.size() / 3;
  return {planes.data(), planes.data() + n, planes.data() + 2 * n, n};
}

struct Batch {
  explicit Batch(std::size_t count, const std::string& material = "materials/a") : n(count), wi(directions(count, 1)), wo(directions(count, 2)), u(3 * count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 0.999F);
    for (float& v : u) v = uniform(random);
    request.set_material(material);
    request.set_operations(v1::OPERATION_EVALUATE | v1::OPERATION_PDF | v1::OPERATION_SAMPLE);
    request.set_count(static_cast<std::uint32_t>(n));
    request.set_wi(bytes_of(wi));
    request.set_wo(bytes_of(wo));
    request.set_numbers(bytes_of(u));
  }
  std::size_t n;
  std::vector<float> wi, wo, u;
  v1::EvaluateRequest request;
};

inline grpc::Status evaluate(Served& s, const v1::EvaluateRequest& request, v1::EvaluateResponse* response = nullptr) {
  Context context;
  v1::EvaluateResponse unused;
  return s.stub->Evaluate(&context, request, response != nullptr ? response : &unused);
}

}  // namespace brdf::test
