// SPDX-License-Identifier: Apache-2.0
// A `.brdfc` file or a measured file, opened as one thing that can be evaluated.
#pragma once

#include <brdf/ingest.h>
#include <brdf/material.h>
#include <brdf/measurement.h>
#include <brdf/metrics.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brdf::cli {

struct SourceOptions {
  EvalLevel level = EvalLevel::balanced;           ///< of a `.brdfc` file
  std::optional<std::uint64_t> prefix;             ///< read only these first bytes of a `.brdfc` file
  SamplePosition position = SamplePosition::edge;  ///< of a MERL table
};

/// Throws Error or Failure as its members say; evaluation is thread-safe. Copies share what was opened.
class MaterialSource {
 public:
  /// Failure(bad_input) or Error for a file that cannot be read, Failure(usage) for a prefix that is no boundary.
  static MaterialSource open(const std::filesystem::path& path, const SourceOptions& options);

  const std::string& path() const noexcept { return path_; }
  std::uint64_t file_bytes() const noexcept { return file_bytes_; }
  const Channels& channels() const noexcept;

  bool is_compressed() const noexcept { return material_.has_value(); }
  const Material& material() const { return material_.value(); }           ///< of a compressed source
  const std::vector<std::byte>& bytes() const noexcept { return bytes_; }  ///< those decoded of a compressed source
  const Measurement& measurement() const { return *measurement_; }         ///< of a measured source

  /// f(wi, wo) in 1/sr; false where a measured file has no value.
  bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept;

  /// Rows of a batch; a measured file's missing values are 0. Keeps what was opened alive.
  BatchEval rows() const;

 private:
  std::string path_;
  std::uint64_t file_bytes_ = 0;
  std::vector<std::byte> bytes_;
  std::optional<Material> material_;
  std::shared_ptr<const Measurement> measurement_;
  std::shared_ptr<const MeasurementInterpolator> interpolator_;
};

/// Rows of a material by the vector kernels: values of channel c of row i at out[i * channels + c].
BatchEval batch_rows(const Material& material);

/// Rows of a measured file.
BatchEval batch_rows(std::shared_ptr<const MeasurementInterpolator> interpolator, int channels);

}  // namespace brdf::cli
