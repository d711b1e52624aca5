// SPDX-License-Identifier: Apache-2.0
// MERL tables: a header and values of any kind. A table that is read has 35 MB or twice that, which no fuzzer invents; it is
// filled here with the numbers of the input over and over.
#include "fuzz/measurement_answers.h"

#include <algorithm>
#include <cstdint>

namespace {

constexpr std::size_t header_bytes = 12, most_bytes = header_bytes + std::size_t{90} * 90 * 360 * 3 * 8;

/// What the header asks for, unless that is no size of a table at all.
std::size_t table_bytes(std::span<const std::uint8_t> header) {
  std::int32_t n[3];
  std::memcpy(n, header.data(), header_bytes);
  std::uint64_t product = 24;
  for (const std::int32_t bins : n) {
    if (bins < 1 || bins > 1 << 16) return 0;
    product *= static_cast<std::uint64_t>(bins);
  }
  return product <= most_bytes - header_bytes ? static_cast<std::size_t>(product) : 0;
}

}  // namespace

/// Input: a byte of options, twelve of the header, the numbers. Whole tables take a second each with sanitizers, so they are made
/// only on demand.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 + header_bytes) return 0;
  const std::span<const std::uint8_t> in(data, size), numbers = in.subspan(1 + header_bytes);
  const std::uint8_t choice = in[0];
  std::vector<std::uint8_t> file(in.begin() + 1, in.begin() + 1 + header_bytes);
  std::size_t values = table_bytes(file);
  if ((choice & 2U) == 0) values = std::min(values, std::size_t{1000});  // truncated
  if ((choice & 4U) != 0) values += choice >> 3;                         // too long, or a number cut in two
  file.resize(header_bytes + values, 0x7F);
  if (!numbers.empty()) {
    std::uint8_t* const table = file.data() + header_bytes;
    std::size_t done = std::min(numbers.size(), values);
    std::memcpy(table, numbers.data(), done);
    for (std::size_t more = 0; done < values; done += more) {
      more = std::min(done, values - done);
      std::memcpy(table + done, table, more);
    }
  }
  brdf::IngestOptions options;
  options.position = (choice & 1U) != 0 ? brdf::SamplePosition::centre : brdf::SamplePosition::edge;
  brdf::test::read_and_interpolate(std::as_bytes(std::span(file)), options);
  return 0;
}
