// SPDX-License-Identifier: Apache-2.0
// A material of the server, asked row by row as brdf-compress asks a file: there, or here after fetching it.
#pragma once

#include "connection.h"

#include <brdf/metrics.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace brdf::query {

struct MaterialOptions {
  std::string name;
  EvalLevel level = EvalLevel::balanced;
  std::optional<std::uint64_t> prefix;
  bool local = false;
};

/// Answers of one version: the first call settles which.
class RemoteMaterial {
 public:
  RemoteMaterial(const Connection& connection, const MaterialOptions& options);

  int channels() const noexcept { return channels_; }
  BatchEval eval_rows();
  BatchEval pdf_rows();
  /// Rows wi.xyz, pdf, weight... for random numbers `first` to `first + n` of `seed`.
  void sample(const Vec3f& wo, std::uint64_t seed, std::uint64_t first, std::size_t n, std::span<float> rows);

 private:
  v1::EvaluateRequest request(std::uint32_t operations, std::size_t n) const;
  std::size_t rows_of_a_call() const noexcept;

  client::Client client_;
  MaterialOptions options_;
  std::string version_;
  int channels_ = 0;
  std::optional<Material> local_;
};

}  // namespace brdf::query
