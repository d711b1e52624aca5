// SPDX-License-Identifier: Apache-2.0
// Any bytes as a measured file, whatever its format.
#include "fuzz/measurement_answers.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  brdf::IngestOptions options;
  options.limits.max_file_bytes = 1 << 20;
  options.limits.max_table_values = 1 << 16;
  options.limits.max_temporary_bytes = 1 << 20;
  options.limits.max_fields = 32;
  options.limits.max_channels = 16;
  brdf::test::read_and_interpolate(std::as_bytes(std::span(data, size)), options);
  return 0;
}
