// SPDX-License-Identifier: Apache-2.0
// The published networks, found by the name of a material.
#pragma once

#include "peers/neural_brdf.h"
#include "peers/npz_file.h"

#include <brdf/measurement.h>
#include <brdf/metrics.h>

#include <filesystem>
#include <optional>
#include <vector>

namespace brdf::cli {

class Networks {
 public:
  /// Opens the files, or, where none is given, nbrdf_*.npz in data/models of $BRDF_SHARED or of ../shared. Throws
  /// Failure(bad_input) when there is none, and what NpzFile throws.
  static Networks open(const std::vector<std::filesystem::path>& files);

  /// The network of a measurement's name, read as those of its kind of table were fitted. Throws Failure(bad_input) for
  /// other than three channels, or where no file has the name.
  peers::NeuralBrdf find(const Measurement& m) const;

 private:
  std::vector<peers::NpzFile> files_;
};

/// Rows of a network.
BatchEval batch_rows(const peers::NeuralBrdf& network);

}  // namespace brdf::cli
