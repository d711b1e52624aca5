// SPDX-License-Identifier: Apache-2.0
#include "row_writer.h"

#include "base/byte_reader.h"

#include <array>
#include <charconv>

namespace brdf::cli {

void RowWriter::write(std::span<const float> values) {
  text_.clear();
  if (format_ == RowFormat::f32) {
    text_.resize(values.size() * sizeof(float));
    const std::span bytes = std::as_writable_bytes(std::span(text_));
    for (std::size_t i = 0; i < values.size(); ++i) {
      base::store_little_endian(values[i], bytes.subspan(i * sizeof(float), sizeof(float)));
    }
  } else {
    std::array<char, 32> number;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto end = std::to_chars(number.data(), number.data() + number.size(), values[i]).ptr;
      text_.append(number.data(), end);
      text_ += (i + 1) % columns_ == 0 ? '\n' : ',';
    }
  }
  out_.write(text_);
}

}  // namespace brdf::cli
