// SPDX-License-Identifier: Apache-2.0
#include "surface/rgb_measurement.h"

#include "surface/channels_to_rgb.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace brdf::render {

Measurement rgb_measurement(Measurement m) {
  if (m.channels.count <= 3) return m;
  const ChannelsToRgb rgb(m.channels);
  const auto channels = static_cast<std::size_t>(m.channels.count);
  std::visit(
      [&](auto& table) {
        std::vector<float> values;
        values.reserve(table.values.size() / channels * 3);
        for (std::size_t i = 0; i + channels <= table.values.size(); i += channels) {
          const Vec3f v = rgb.unclipped(std::span<const float>(table.values).subspan(i, channels));
          values.insert(values.end(), {v.x, v.y, v.z});
        }
        table.values = std::move(values);
      },
      m.table);
  m.channels = {ChannelModel::rgb, 3, {}};
  return m;
}

}  // namespace brdf::render
