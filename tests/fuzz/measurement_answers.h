// SPDX-License-Identifier: Apache-2.0
// What holds for any bytes as a measured file: an Error, or a measurement that interpolates to numbers.
#pragma once

#include <brdf/error.h>
#include <brdf/ingest.h>
#include <brdf/measurement.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

namespace brdf::test {

inline void read_and_interpolate(std::span<const std::byte> bytes, const IngestOptions& options) {
  (void)sniff(bytes, bytes.size());
  try {
    const Measurement m = read_measurement(bytes, "input", options);
    const MeasurementInterpolator f(m);
    std::vector<double> value(static_cast<std::size_t>(m.channels.count));
    for (int i = 0; i <= 12; ++i)
      for (int j = 0; j <= 12; ++j) {
        const double a = 0.13 * i, b = 0.13 * j, phi = 0.7 * i + 0.3 * j;  // up to 89.4 degrees
        const bool measured = f.eval({std::sin(a), 0, std::cos(a)},
                                     {std::sin(b) * std::cos(phi), std::sin(b) * std::sin(phi), std::cos(b)}, value);
        for (const double v : value)
          if (!(v >= 0) || !std::isfinite(v) || (!measured && v != 0)) std::abort();
      }
  } catch (const Error& e) {
    if (std::strncmp(e.what(), "input", 5) != 0) std::abort();  // every sentence names its file
  }
}

}  // namespace brdf::test
