// SPDX-License-Identifier: Apache-2.0
// Any component and any payloads under sound checksums (payload_parts.h): like brdfc, but behind its gate.
#include "fuzz/material_answers.h"
#include "fuzz/payload_parts.h"

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = brdf::test::payload_parts(std::as_bytes(std::span(data, size))).build();
  brdf::test::check_every_level(file, false, [](const brdf::Material& m) { brdf::test::require_numbers(m); });
  return 0;
}
