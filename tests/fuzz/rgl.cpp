// SPDX-License-Identifier: Apache-2.0
// RGL materials: a tensor file is put together from the input, so that names, offsets and sizes are near the truth and
// what is inside the tables is reached.
#include "fuzz/measurement_answers.h"
#include "support/tensor_file_builder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

namespace {

constexpr std::array<const char*, 16> names{"phi_i", "theta_i", "sigma", "ndf", "vndf", "rgb", "jacobian", "description",
                                            "luminance", "spectra", "wavelengths", "valid", "wvls", "M", "", "other"};
constexpr std::size_t most_bytes = 4096;

/// Input: fields. Each has a byte with the number of its name and flags, its element type, its number of dimensions and
/// these, a byte each; then its data, repeated from four bytes, or byte by byte when flag 0x10 is set. Flag 0x20: the
/// field shares the data of the first. Flag 0x40: its first dimension is enormous.
std::vector<std::byte> tensor_file(std::span<const std::uint8_t> in) {
  const auto number = [&in]() -> std::uint8_t {
    if (in.empty()) return 0;
    const std::uint8_t b = in.front();
    in = in.subspan(1);
    return b;
  };
  brdf::test::TensorFileBuilder file;
  std::uint64_t directory = 18;
  std::vector<brdf::test::TensorFieldSpec> fields;
  while (!in.empty() && fields.size() < 20) {
    const std::uint8_t head = number();
    brdf::test::TensorFieldSpec field{names[head & 0x0FU], number(), {}, {}, std::nullopt};
    const int dimensions = number() % 18;
    std::uint64_t count = 1;
    for (int i = 0; i < dimensions; ++i) {
      field.shape.push_back(number());
      count = std::min<std::uint64_t>(count * field.shape.back(), most_bytes);
    }
    const std::size_t bytes = std::min<std::size_t>(count * (field.type == 10 ? 4 : 1), most_bytes);
    std::vector<std::uint8_t> data(bytes);
    const std::size_t given = std::min({bytes, in.size(), (head & 0x10U) != 0 ? bytes : std::size_t{4}});
    std::copy_n(in.begin(), given, data.begin());
    in = in.subspan(given);
    for (std::size_t i = given; i < bytes && given > 0; ++i) data[i] = data[i - given];
    const auto raw = std::as_bytes(std::span(data));
    field.data.assign(raw.begin(), raw.end());
    if ((head & 0x40U) != 0 && !field.shape.empty()) field.shape[0] <<= 56;
    if ((head & 0x20U) != 0) field.stated_offset = 0;
    directory += 13 + field.name.size() + 8 * field.shape.size();
    fields.push_back(std::move(field));
  }
  for (brdf::test::TensorFieldSpec& field : fields) {
    if (field.stated_offset) field.stated_offset = directory;
    file.add(std::move(field));
  }
  return file.build();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  brdf::IngestOptions options;
  options.limits.max_table_values = 1 << 16;
  options.limits.max_temporary_bytes = 1 << 18;
  options.limits.max_fields = 16;
  brdf::test::read_and_interpolate(tensor_file({data, size}), options);
  return 0;
}
