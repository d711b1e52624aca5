// SPDX-License-Identifier: Apache-2.0
// The vector that the solver moves, and the lobes that it stands for.
#pragma once

#include <brdf/lobes.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace brdf::fit {

/// Where each lobe's parameters lie. All are logarithms: roughness, f90 and colours are positive, span decades, and
/// what matters of each is its ratio. ggx: alpha, f90, colour...; Lambert: colour...
class Layout {
 public:
  Layout(std::vector<LobeKind> kinds, int channels);
  const std::vector<LobeKind>& kinds() const noexcept { return kinds_; }
  int channels() const noexcept { return channels_; }
  int size() const noexcept { return size_; }
  /// Index of log alpha; log f90 follows. Not for Lambert.
  int shape(std::size_t lobe) const noexcept { return first_[lobe]; }
  int color(std::size_t lobe) const noexcept { return first_[lobe] + (kinds_[lobe] == LobeKind::lambert ? 0 : 2); }

 private:
  std::vector<LobeKind> kinds_;
  std::vector<int> first_;
  int channels_, size_ = 0;
};

Layout layout_of(const LobeSet& set);
std::vector<double> to_parameters(const LobeSet& set);
LobeSet from_parameters(const Layout& layout, const std::vector<double>& p);

/// Lower and upper bound of every parameter, for values of unit scale.
std::pair<std::vector<double>, std::vector<double>> parameter_bounds(const Layout& layout);

}  // namespace brdf::fit
