// SPDX-License-Identifier: Apache-2.0
// The values at the nodes of a table while it is made.
#pragma once

#include "sample/density.h"
#include "sample/integrand.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brdf::sample {

/// Densities of the warped unit square at the nodes of all views, before they become distributions.
class DensityNodes {
 public:
  using Table = ComponentTable;
  static constexpr std::size_t edges = row_cells + 1, per_view = Table::rows_per_view * edges;

  explicit DensityNodes(const HeightWarp& warp);

  /// Most bytes that one of these takes with its work, or two components of densities that are assigned.
  static std::uint64_t temporary_bytes(int channels) noexcept;

  /// Follows `f` at the nodes. Each view's integral becomes 1; it keeps the integral of f before.
  void tabulate(Integrand& f);
  /// Raises nodes around points between them where f is more than `most` times what the density says: what is narrower
  /// than a cell of the table must not become a rare sample of large weight.
  void cover(Integrand& f, double most);

  /// Takes densities of another origin; each view's integral becomes 1.
  void assign(std::span<const double> density);

  std::span<const double> view(std::size_t k) const { return std::span(density_).subspan(k * per_view, per_view); }
  const std::array<double, Table::views>& integrals() const noexcept { return integrals_; }

 private:
  struct Probe;
  std::vector<Probe> probes(std::size_t parts) const;

  double integral(std::span<const double> density) const noexcept;
  void normalise(std::size_t view);
  double between(std::size_t k, const Probe& p) const noexcept;
  /// Probes between two views, or `to_upper` below the first one.
  void cover_view(Integrand& f, double most, std::span<const Probe> probes, std::size_t lower, std::size_t upper, double to_upper,
                  std::vector<double>& raised) const;
  void raise(std::vector<double>& raised, std::size_t node, const Probe& at, double wanted, double found) const;

  HeightWarp warp_;
  std::vector<double> density_;
  std::array<double, Table::views> integrals_{};
};

}  // namespace brdf::sample
