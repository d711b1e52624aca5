// SPDX-License-Identifier: Apache-2.0
#include "encode/stored_cdf.h"

#include "container/content.h"
#include "container/density_codes.h"
#include "decode/sampling_tables.h"
#include "sample/stored_density.h"

#include <algorithm>
#include <cmath>

namespace brdf::encode {

std::vector<std::byte> with_stored_cdf(std::span<const std::byte> bytes, EvalLevel level) {
  DecodeOptions options;
  options.level = level;
  const sample::NodeDensities nodes = sample::node_densities(*decode::sampling_tables(bytes, options));
  container::DensityCodes codes;
  codes.level = level;
  for (const std::vector<double>& density : nodes.components) {
    std::vector<std::int16_t>& component = codes.components.emplace_back();
    for (const double d : density) {
      const double code = std::round(container::density_steps * std::log2(d));
      component.push_back(static_cast<std::int16_t>(
          std::clamp(code, -static_cast<double>(container::largest_density_code), static_cast<double>(container::largest_density_code))));
    }
  }
  for (std::size_t k = 0; k < container::density_views; ++k) codes.second[k] = static_cast<std::uint8_t>(std::lround(255 * nodes.second[k]));
  container::Content content = container::unpack(bytes, options.limits, false).content;
  content.sampling = container::write_density(codes);
  return container::pack(content);
}

}  // namespace brdf::encode
