// SPDX-License-Identifier: Apache-2.0
// The measurements behind `bench`.
#pragma once

#include "bench_row.h"
#include "bench_speed.h"
#include "material_source.h"
#include "networks.h"

#include <brdf/encode.h>

#include <optional>
#include <vector>

namespace brdf::cli {

struct BenchSetting {
  std::string preset;
  int effort = 0;
  std::optional<std::uint64_t> target_size;
};

/// One measured file and what every row about it needs.
class BenchMaterial {
 public:
  BenchMaterial(const MaterialSource& source, int threads);

  /// Compresses once and measures at each level. Throws what compress() throws.
  std::vector<BenchRow> measure(const BenchSetting& setting, std::span<const EvalLevel> levels) const;

  /// The row of the material's network.
  BenchRow measure(const peers::NeuralBrdf& network) const;

 private:
  BenchRow begin_row(std::uint64_t bytes) const;
  BenchRow measure_level(const EncodeResult& encoded, EvalLevel level) const;

  MaterialSource source_;
  int threads_;
  Comparison comparison_;
  double native_bytes_;
  std::optional<peers::RawTable> raw_;
};

}  // namespace brdf::cli
