// SPDX-License-Identifier: Apache-2.0
#include "raw_table.h"

#include <brdf/error.h>

#include "arc_tangent.h"
#include "raw_table_batch.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <numbers>
#include <string>
#include <vector>

namespace brdf::peers {
namespace {

constexpr std::size_t channels = 3;

struct Size {
  std::size_t n_h, n_d, n_p;
  std::size_t cells() const noexcept { return n_h * n_d * n_p; }
};

Size checked_size(const HalfDifferenceTable& t) {
  constexpr int most = 1 << 14;
  const bool sound = t.n_theta_h >= 2 && t.n_theta_d >= 2 && t.n_phi_d >= 2 && t.n_theta_h <= most &&
                     t.n_theta_d <= most && t.n_phi_d <= most;
  const Size size{static_cast<std::size_t>(t.n_theta_h), static_cast<std::size_t>(t.n_theta_d),
                  static_cast<std::size_t>(t.n_phi_d)};
  if (!sound || t.valid.size() != size.cells() || t.values.size() != channels * size.cells() ||
      channels * size.n_h * size.n_d * (size.n_p + 1) + 8 > std::numeric_limits<std::int32_t>::max()) {
    throw Error(ErrorCode::invalid_argument, "raw table: has " + std::to_string(t.values.size()) + " values for " +
                                                 std::to_string(t.n_theta_h) + " x " + std::to_string(t.n_theta_d) +
                                                 " x " + std::to_string(t.n_phi_d) +
                                                 " bins, three per bin and at least 2 bins an axis are needed");
  }
  return size;
}

/// The mean of a cell's valid neighbours. One step is enough: the corners of one look-up are neighbours of each other.
std::array<float, channels> neighbours_mean(const HalfDifferenceTable& t, const Size& n, std::size_t i, std::size_t j,
                                            std::size_t k) {
  std::array<float, channels> sum{};
  float count = 0;
  for (std::size_t a = i > 0 ? i - 1 : 0; a <= std::min(i + 1, n.n_h - 1); ++a) {
    for (std::size_t b = j > 0 ? j - 1 : 0; b <= std::min(j + 1, n.n_d - 1); ++b) {
      for (const std::size_t c : {(k + n.n_p - 1) % n.n_p, k, (k + 1) % n.n_p}) {
        const std::size_t cell = (a * n.n_d + b) * n.n_p + c;
        if (t.valid[cell] == 0) continue;
        for (std::size_t channel = 0; channel < channels; ++channel)
          sum[channel] += t.values[channels * cell + channel];
        ++count;
      }
    }
  }
  for (float& v : sum) v = count > 0 ? v / count : 0;
  return sum;
}

/// `condition ? yes : no` without a branch, which random directions would mispredict every other time.
float choose(bool condition, float yes, float no) noexcept {
  const std::uint32_t mask = 0U - static_cast<std::uint32_t>(condition);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(yes) & mask) | (std::bit_cast<std::uint32_t>(no) & ~mask));
}

/// Angle of (x, y) in [0, pi / 2] from the squares of x and y.
float first_quadrant_angle(float y2, float x2) noexcept {
  const float r2 = std::min(x2, y2) / std::max(std::max(x2, y2), 1e-30F), r = std::sqrt(r2), r4 = r2 * r2;
  constexpr const auto& a = arc_tangent_series;
  // two chains instead of one half as fast
  const float even = a[0] + r4 * (a[2] + r4 * (a[4] + r4 * a[6])), odd = a[1] + r4 * (a[3] + r4 * (a[5] + r4 * a[7]));
  const float angle = r + r * r2 * (even + r2 * odd);
  return choose(y2 > x2, static_cast<float>(std::numbers::pi / 2) - angle, angle);
}

struct AxisPosition {
  std::int32_t lower;
  float fraction;
};

AxisPosition axis_position(float x, std::int32_t last) noexcept {
  const float within = std::min(choose(x > 0, x, 0), static_cast<float>(last));  // 0 for what is no number
  const std::int32_t lower = std::min(static_cast<std::int32_t>(within), last - 1);
  return {lower, within - static_cast<float>(lower)};
}

AxisPosition circle_position(float x, std::int32_t n) noexcept {
  const auto size = static_cast<float>(n);
  const float turned = x + choose(x < 0, size, 0);
  const float within = choose(turned < size, turned, 0);  // 0 for what is no number
  const std::int32_t lower = std::min(static_cast<std::int32_t>(within), n - 1);
  return {lower, within - static_cast<float>(lower)};
}

}  // namespace

void RawTable::Free::operator()(float* p) const noexcept { std::free(p); }

RawTable::RawTable(const HalfDifferenceTable& table) {
  const Size n = checked_size(table);
  // Pages of 2 MiB where the system has them: random access to 4 KiB pages would spend as much on addresses as on data.
  constexpr std::size_t page = std::size_t{2} << 20;
  constexpr std::size_t read_behind = 2;  // eight floats are loaded where six are needed
  const std::size_t row = channels * (n.n_p + 1), floats = n.n_h * n.n_d * row;
  bytes_ = floats * sizeof(float);
  const std::size_t allocated = ((floats + read_behind) * sizeof(float) + page - 1) / page * page;
  texels_.reset(static_cast<float*>(std::aligned_alloc(page, allocated)));
  if (!texels_) throw std::bad_alloc();
  madvise(texels_.get(), allocated, MADV_HUGEPAGE);

  float* to = texels_.get();
  for (std::size_t i = 0, cell = 0; i < n.n_h; ++i) {
    for (std::size_t j = 0; j < n.n_d; ++j) {
      const float* first = to;
      for (std::size_t k = 0; k < n.n_p; ++k, ++cell, to += channels) {
        if (table.valid[cell] != 0) {
          std::copy_n(table.values.data() + channels * cell, channels, to);
        } else {
          std::ranges::copy(neighbours_mean(table, n, i, j, k), to);
        }
      }
      to = std::copy_n(first, channels, to);
    }
  }
  std::fill_n(to, read_behind, 0.0F);
  view_ = {texels_.get(),
           table.n_theta_h,
           table.n_theta_d,
           table.n_phi_d,
           static_cast<std::int32_t>(row),
           static_cast<std::int32_t>(row * n.n_d),
           table.position == SamplePosition::centre ? 0.5F : 0.0F,
           table.full_circle};
}

void RawTable::eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept {
  look_up_batch(view_, wi, wo, f);
}

void RawTable::eval(const Vec3f& wi, const Vec3f& wo, std::span<float, 3> f) const noexcept {
  std::ranges::fill(f, 0.0F);
  if (!(wi.z > 0) || !(wo.z > 0)) return;
  constexpr float pi = std::numbers::pi_v<float>, quarter = pi / 2;
  const Vec3f s = wi + wo, d = wi - wo;
  const float rho2 = s.x * s.x + s.y * s.y, s2 = rho2 + s.z * s.z, length = std::sqrt(s2);
  const bool pole = rho2 < 1e-24F * s2;
  const float c = choose(pole, 1, s.x), e = choose(pole, 0, s.y);
  const float x = (c * d.x + e * d.y) * s.z - rho2 * d.z, y = (c * d.y - e * d.x) * length;
  const float theta_h = first_quadrant_angle(rho2, s.z * s.z);
  const float theta_d = first_quadrant_angle(d.x * d.x + d.y * d.y + d.z * d.z, s2);
  const float azimuth = first_quadrant_angle(y * y, x * x);
  const float phi_d = choose((x < 0) != (y < 0), pi - azimuth, azimuth) + choose(view_.full_circle && y < 0, pi, 0);
  const RawTableView& t = view_;
  const AxisPosition h = axis_position(std::sqrt(theta_h / quarter) * static_cast<float>(t.n_h) - t.offset, t.n_h - 1);
  const AxisPosition v = axis_position(theta_d * (static_cast<float>(t.n_d) / quarter) - t.offset, t.n_d - 1);
  const AxisPosition p =
      circle_position(phi_d * (static_cast<float>(t.n_p) / (t.full_circle ? 2 * pi : pi)) - t.offset, t.n_p);
  const float* corner = t.texels + (h.lower * t.step_h + v.lower * t.step_d + 3 * p.lower);
  const std::array rows{corner, corner + t.step_d, corner + t.step_h, corner + t.step_h + t.step_d};
  const std::array weights{(1 - h.fraction) * (1 - v.fraction), (1 - h.fraction) * v.fraction,
                           h.fraction * (1 - v.fraction), h.fraction * v.fraction};
  std::array<float, 6> sum{};
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[r] * rows[r][k];
  for (std::size_t k = 0; k < channels; ++k) f[k] = std::max(0.0F, sum[k] + p.fraction * (sum[k + 3] - sum[k]));
}

}  // namespace brdf::peers
