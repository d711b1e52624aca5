// SPDX-License-Identifier: Apache-2.0
// Any bytes as a profile, as they are and under a sound checksum: an Error, or a profile that is written as it was read.
#include "base/byte_reader.h"
#include "base/hash.h"

#include <brdf/error.h>
#include <brdf/profile.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace {

void check(std::span<const std::byte> bytes) {
  brdf::Profile p;
  try {
    p = brdf::Profile::read(bytes);
  } catch (const brdf::Error&) {
    return;
  }
  const std::vector<std::byte> again = p.write();
  if (!std::equal(again.begin(), again.end(), bytes.begin(), bytes.end())) std::abort();
  brdf::Profile twice = p;
  twice.merge(p);
  if (brdf::Profile::read(twice.write()) != twice) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  check(bytes);
  if (size < 4) return 0;
  std::vector<std::byte> sealed(bytes.begin(), bytes.end());
  const std::span all(sealed);
  brdf::base::store_little_endian(brdf::base::xxh32(all.first(all.size() - 4)), all.last(4));
  check(sealed);
  return 0;
}
