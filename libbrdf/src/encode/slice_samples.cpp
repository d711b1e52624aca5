// SPDX-License-Identifier: Apache-2.0
#include "encode/slice_samples.h"

#include "ingest/visible_normal_lookup.h"
#include "residual/residual_code.h"
#include "slices/slice_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::encode {
namespace {

constexpr double epsilon_share = 0.04;  // of the median: what lies far below it is dark in any picture
constexpr double largest_log2_ndf = 29;
constexpr double nothing_visible = 1e-9;       // density of a row

double median_of_positive(std::vector<float> values) {
  std::erase_if(values, [](float v) { return !(v > 0); });
  if (values.empty()) return 1;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

}  // namespace

std::optional<residual::SliceFrame> slice_frame(const Measurement& m, int ndf_step) {
  const auto* t = std::get_if<VisibleNormalTable>(&m.table);
  if (t == nullptr || !t->jacobian || t->theta_i.size() < 2 || t->theta_i.size() > static_cast<std::size_t>(residual::max_m)) return {};
  if (t->width > residual::max_k || t->height > 2 * residual::max_l || t->ndf_width > 255 || t->vndf_height > 255 || t->vndf_height < 4) return {};
  if (!ingest::rows_are_equal(t->ndf, static_cast<std::size_t>(t->ndf_width))) return {};
  residual::SliceFrame f;
  for (const float theta : t->theta_i)
    f.theta_i.push_back(static_cast<std::uint16_t>(std::clamp(std::lround(static_cast<double>(theta) * 2 / std::numbers::pi * 65535), 0L, 65535L)));
  if (std::adjacent_find(f.theta_i.begin(), f.theta_i.end(), [](auto a, auto b) { return a >= b; }) != f.theta_i.end()) return {};
  f.width = static_cast<std::uint8_t>(t->width);
  f.height = static_cast<std::uint8_t>(t->height);
  f.rows = static_cast<std::uint8_t>(t->vndf_height);
  f.ndf_step = static_cast<std::uint8_t>(ndf_step);
  const double per_octave = std::exp2(0.5 * ndf_step);
  for (int x = 0; x < t->ndf_width; ++x) {
    const double value = std::max(static_cast<double>(t->ndf[static_cast<std::size_t>(x)]), 1e-30);
    f.ndf.push_back(static_cast<std::int16_t>(std::lround(std::clamp(std::log2(value), -largest_log2_ndf, largest_log2_ndf) * per_octave)));
  }
  f.epsilon = static_cast<std::uint8_t>(residual::epsilon_code(epsilon_share * median_of_positive(t->values)));
  return f;
}

SliceSamples sample_slices(const Measurement& m, const residual::SliceFrame& frame) {
  const auto& table = std::get<VisibleNormalTable>(m.table);
  const ingest::VisibleNormalLookup lookup(table, m.channels.count);
  const slices::SliceMap map(frame);
  SliceSamples s;
  s.width = frame.width;
  s.half_height = static_cast<std::size_t>(frame.half_height());
  s.slices = frame.theta_i.size();
  s.channels = static_cast<std::size_t>(m.channels.count);
  s.value.resize(s.nodes() * s.channels);
  s.y.resize(s.value.size());
  const double epsilon = residual::epsilon_of(frame.epsilon);
  std::vector<double> f(s.channels), mirrored(s.channels);
  std::size_t at = 0;
  for (std::size_t slice = 0; slice < s.slices; ++slice)
    for (std::size_t j = 0; j < s.half_height; ++j)
      for (std::size_t i = 0; i < s.width; ++i) {
        const double v = static_cast<double>(j) / static_cast<double>(frame.height - 1);
        double scale = 0.5;
        if (map.row_density(slice, v) < nothing_visible) {  // no angle leads here, yet interpolation does
          const float* here = table.values.data() + ((slice * frame.height + j) * s.width + i) * s.channels;
          const float* there = table.values.data() + ((slice * frame.height + (frame.height - 1U - j)) * s.width + i) * s.channels;
          std::copy_n(here, s.channels, f.begin());
          std::copy_n(there, s.channels, mirrored.begin());
        } else {
          const slices::SliceAngles a = map.angles(slice, static_cast<double>(i) / static_cast<double>(s.width - 1), v);
          lookup.reflected(a.theta_i, {a.u_h, a.v_h}, f);
          lookup.reflected(a.theta_i, {a.u_h, 1 - a.v_h}, mirrored);
          scale /= std::max(map.jacobian(a), 1e-30);
        }
        for (std::size_t c = 0; c < s.channels; ++c, ++at) {
          s.value[at] = std::max(scale * (f[c] + mirrored[c]), 0.0);
          s.y[at] = std::log(s.value[at] + epsilon);
        }
      }
  return s;
}

}  // namespace brdf::encode
