// SPDX-License-Identifier: Apache-2.0
#include "profile/profile_cells.h"

#include <brdf/error.h>
#include <brdf/metrics.h>
#include <brdf/profile.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace brdf {
namespace {

constexpr int places = 2;                 // along each axis of a cell
constexpr double darkest_place = 0.1;     // of the mean f of its cell: a place of less counts as if it had that
constexpr double darkest_cell = 1e-3;     // of the mean f that was asked for: a cell of less counts as if it had that
constexpr double log_offset = 0.01;       // of the mean f of the cell

}  // namespace

/// The rows in the order of their cells, and what the reference answers.
struct ProfileComparison::State {
  struct Cell {
    std::size_t first = 0, count = 0;  ///< rows
    double share = 0;                  ///< of the contribution, of each row once all is known
    double scale = 0;                  ///< mean f of the reference over rows and channels
  };
  int channels = 0;
  std::vector<Vec3f> wi, wo;
  std::vector<float> f;
  std::vector<Cell> cells;
};

/// Closes the gaps of rows that are NaN in any channel.
void ProfileComparison::leave_out_unmeasured(State& s) {
  const auto n = static_cast<std::size_t>(s.channels);
  std::size_t kept = 0;
  for (State::Cell& c : s.cells) {
    const std::size_t first = kept;
    for (std::size_t row = c.first; row < c.first + c.count; ++row) {
      const auto values = std::span(s.f).subspan(row * n, n);
      if (std::any_of(values.begin(), values.end(), [](float v) { return std::isnan(v); })) continue;
      s.wi[kept] = s.wi[row];
      s.wo[kept] = s.wo[row];
      std::copy(values.begin(), values.end(), s.f.begin() + static_cast<std::ptrdiff_t>(kept * n));
      ++kept;
    }
    c.first = first;
    c.count = kept - first;
  }
  s.wi.resize(kept);
  s.wo.resize(kept);
  s.f.resize(kept * n);
  std::erase_if(s.cells, [](const State::Cell& c) { return c.count == 0; });
}

ProfileComparison::ProfileComparison(const BatchEval& reference, int channels, const MaterialProfile& asked) {
  if (channels < 1)
    throw Error(ErrorCode::invalid_argument, "comparison: channels is " + std::to_string(channels) + ", allowed is 1 or more");
  auto state = std::make_shared<State>();
  State& s = *state;
  s.channels = channels;
  for (std::size_t cell = 0; cell < asked.histogram.size(); ++cell) {
    if (asked.histogram[cell] == 0) continue;
    State::Cell c{s.wi.size(), 0, 0, 0};
    profile::for_places(cell, places, profile::lowest_cosine, [&](const Vec3d& wi, const Vec3d& wo) {
      s.wi.emplace_back(wi);
      s.wo.emplace_back(wo);
    });
    c.count = s.wi.size() - c.first;
    if (c.count == 0) continue;  // too close to the horizon
    c.share = static_cast<double>(asked.histogram[cell]);
    s.cells.push_back(c);
  }
  if (s.cells.empty()) throw Error(ErrorCode::no_data, "the profile asks nothing of this material: no reflection above the horizon contributes");
  const auto n = static_cast<std::size_t>(channels);
  s.f.resize(s.wi.size() * n);
  reference(s.wi, s.wo, s.f);
  leave_out_unmeasured(s);
  if (s.cells.empty()) throw Error(ErrorCode::no_data, "the profile asks nothing of this material that was measured");
  double total = 0, mean = 0;
  for (State::Cell& c : s.cells) {
    total += c.share;
    c.share /= static_cast<double>(c.count);
  }
  for (State::Cell& c : s.cells) {
    c.share /= total;
    for (std::size_t i = c.first * n; i < (c.first + c.count) * n; ++i) c.scale += static_cast<double>(s.f[i]);
    c.scale /= static_cast<double>(c.count * n);
    mean += c.share * static_cast<double>(c.count) * c.scale;
  }
  for (State::Cell& c : s.cells) c.scale = std::max({c.scale, darkest_cell * mean, 1e-30});
  state_ = std::move(state);
}

ProfileError ProfileComparison::score(const BatchEval& candidate) const {
  const State& s = *state_;
  const auto n = static_cast<std::size_t>(s.channels);
  std::vector<float> f(s.f.size());
  candidate(s.wi, s.wo, f);
  double squares = 0, logs = 0;
  for (const State::Cell& c : s.cells) {
    const double offset = log_offset * c.scale;
    double square = 0, logarithm = 0;
    for (std::size_t i = c.first * n; i < (c.first + c.count) * n; ++i) {
      const auto wanted = static_cast<double>(s.f[i]), found = static_cast<double>(f[i]);
      // the places of a cell contribute in the ratio of their f: (f / scale) ((found - f) / f)^2
      square += (found - wanted) * (found - wanted) / (std::max(wanted, darkest_place * c.scale) * c.scale);
      logarithm += std::abs(std::log((std::max(found, 0.0) + offset) / (wanted + offset)));
    }
    squares += c.share * square / static_cast<double>(n);
    logs += c.share * logarithm / static_cast<double>(n);
  }
  return {std::sqrt(squares), logs};
}

std::size_t ProfileComparison::size() const noexcept { return state_->wi.size(); }

}  // namespace brdf
