// SPDX-License-Identifier: Apache-2.0
// Any bytes as a `.brdfc` file: an Error that check_file foresees, or a material whose every answer is a number.
#include "fuzz/material_answers.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  for (const bool allow_prefix : {false, true})
    brdf::test::check_every_level(bytes, allow_prefix, [](const brdf::Material& m) { brdf::test::require_numbers(m); });
  return 0;
}
