// SPDX-License-Identifier: Apache-2.0
#include "encode/size_search.h"

#include "encode/slice_samples.h"
#include "fit/parallel_jobs.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

namespace brdf::encode {
namespace {

constexpr std::uint64_t slices_from = 300;       // bytes: below, the ndf alone would take a quarter of the file
constexpr std::uint64_t everything_from = 6000;  // bytes: from here on a file may hold every number of the instrument
constexpr double choosing_quality = 0.1;

/// In the order in which they are tried.
constexpr Candidate::SliceSettings slice_settings[] = {{8, 4, 0}, {8, 1, 0}, {6, 4, 0}, {12, 4, 0}, {8, 0, 0}};

int slice_coefficients_for(std::uint64_t bytes) noexcept {
  return static_cast<int>(std::clamp<std::uint64_t>(bytes * 6 / 10 + 700, 1000, Candidate::largest_matrix));
}

/// Decibels over the three figures that are reported; larger is better.
double merit(const ErrorReport& r) { return (r.psnr_env + r.psnr_lights - 20 * std::log10(std::max(r.log_mae.all, 1e-9))) / 3; }

double measured_merit(const Encoded& e, const Verification& verification) {
  return merit(verification.score(Material::decode(e.bytes)));
}

/// The same coefficients with other balanced tables: they are resampled from the slices, so only the header changes.
std::vector<residual::BasisCodes> table_variants(const residual::BasisCodes& basis, int count) {
  std::vector<residual::BasisCodes> out;
  constexpr struct {
    int table, kappa_h, kappa_d;
  } changes[] = {{0, 0, 0}, {1, 0, 0}, {0, 3, 0}, {1, 3, 0}, {2, 0, 0}, {1, 3, 4}, {3, 0, 0}, {2, 3, 0}, {1, 6, 0}, {1, -3, 0}, {3, 3, 4}, {1, 0, 4}};
  for (const auto& change : changes) {
    if (static_cast<int>(out.size()) == count) break;
    residual::BasisCodes b = basis;
    b.table = static_cast<std::uint8_t>(change.table);
    b.kappa_h = static_cast<std::uint8_t>(std::clamp(b.kappa_h + change.kappa_h, 0, 31));
    b.kappa_d = static_cast<std::uint8_t>(std::clamp(b.kappa_d + change.kappa_d, 0, 15));
    out.push_back(b);
  }
  return out;
}

/// Gives `e` the best table and returns its merit.
double choose_table(Encoded& e, int count, const Verification& verification) {
  double best = -1e9;
  Encoded chosen;
  for (const residual::BasisCodes& basis : table_variants(e.content.residual.basis, count)) {
    Encoded trial = e;
    trial.content.residual.basis = basis;
    trial.bytes = container::pack(trial.content);
    const double m = measured_merit(trial, verification);
    if (m > best) {
      best = m;
      chosen = std::move(trial);
    }
  }
  e = std::move(chosen);
  return best;
}

}  // namespace

Encoded encode_to_size(const SearchSpace& space, std::uint64_t bytes, const std::function<void(double share)>& done) {
  const bool slices = !space.reciprocal && bytes >= slices_from && slice_frame(space.measurement, 8).has_value();
  std::vector<Candidate::SliceSettings> settings;
  if (slices) {
    for (int i = 0; i < space.effort.slice_variants; ++i) {
      Candidate::SliceSettings s = slice_settings[i];
      s.coefficients = slice_coefficients_for(bytes);
      settings.push_back(s);
    }
    if (bytes >= everything_from) settings.push_back({bytes < 12000 ? 12 : 16, 4, static_cast<int>(residual::max_coefficients)});
  }
  // a measurement with slices of its own rarely gains from more than one basis besides
  const std::size_t bases = slices ? std::max<std::size_t>(space.bases.size() / 2, 1) : space.bases.size(), count = bases + settings.size();
  std::vector<Encoded> tried(count);
  std::mutex mutex;
  std::size_t ended = 0;
  fit::run_jobs(count, space.threads, [&](std::size_t i, bool) {
    if (i < bases) {
      tried[i] = Candidate::half_difference(space.measurement, space.frame, space.bases[i], space.reciprocal, space.effort, space.queries)
                     .encode_to_size(bytes);
    } else if (const auto candidate = Candidate::in_slices(space.measurement, space.frame, space.bases.front(), settings[i - bases],
                                                           space.effort, space.queries)) {
      tried[i] = candidate->encode_to_size(bytes);
    }
    const std::lock_guard lock(mutex);
    done(static_cast<double>(++ended) / static_cast<double>(count));
  });

  // bases of one kind are compared by the error model that they share; the two kinds, and the tables, by measurement
  const auto best_of = [&](std::size_t first, std::size_t last) -> Encoded* {
    Encoded* best = nullptr;
    for (std::size_t i = first; i < last; ++i)
      if (!tried[i].bytes.empty() && (best == nullptr || tried[i].error < best->error)) best = &tried[i];
    return best;
  };
  Encoded* best = best_of(0, bases);
  if (!slices) return best != nullptr ? std::move(*best) : Encoded{};
  const Verification verification(space.measurement, choosing_quality, space.threads);
  double merit_so_far = best != nullptr ? measured_merit(*best, verification) : -1e9;
  for (std::size_t i = bases; i < count; ++i) {
    if (tried[i].bytes.empty() || tried[i].content.residual.empty()) continue;
    const double m = choose_table(tried[i], space.effort.table_variants, verification);
    if (m <= merit_so_far) continue;
    merit_so_far = m;
    best = &tried[i];
  }
  return best != nullptr ? std::move(*best) : Encoded{};
}

}  // namespace brdf::encode
