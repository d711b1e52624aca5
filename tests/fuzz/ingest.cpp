// SPDX-License-Identifier: Apache-2.0
// Any bytes as a measured file, whatever its format: an Error, or a measurement that interpolates to numbers.
#include <brdf/error.h>
#include <brdf/ingest.h>
#include <brdf/measurement.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  (void)brdf::sniff(bytes, size);
  brdf::IngestOptions options;
  options.limits.max_file_bytes = 1 << 20;
  options.limits.max_table_values = 1 << 16;
  options.limits.max_fields = 32;
  options.limits.max_channels = 16;
  try {
    const brdf::Measurement m = brdf::read_measurement(bytes, "input", options);
    const brdf::MeasurementInterpolator f(m);
    std::vector<double> value(static_cast<std::size_t>(m.channels.count));
    for (int i = 0; i <= 12; ++i)
      for (int j = 0; j <= 12; ++j) {
        const double a = 0.13 * i, b = 0.13 * j, phi = 0.7 * i + 0.3 * j;  // up to 89.4 degrees
        const bool measured = f.eval({std::sin(a), 0, std::cos(a)},
                                     {std::sin(b) * std::cos(phi), std::sin(b) * std::sin(phi), std::cos(b)}, value);
        for (const double v : value)
          if (!(v >= 0) || !std::isfinite(v) || (!measured && v != 0)) std::abort();
      }
  } catch (const brdf::Error&) {
    // the one answer that bad bytes may get
  }
  return 0;
}
