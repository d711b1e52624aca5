// SPDX-License-Identifier: Apache-2.0
#include "row_queries.h"

#include "row_reader.h"
#include "row_writer.h"

#include <unistd.h>

#include <cmath>
#include <vector>

namespace brdf::cli {
namespace {

constexpr std::size_t block_rows = 16384;
constexpr std::size_t row_numbers = 6;

Vec3f unit(const float* xyz) noexcept {
  const double x = xyz[0], y = xyz[1], z = xyz[2], length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0)) return {0, 0, 0};
  // Directions that are unit already are left alone to the last bit.
  if (std::abs(length - 1) <= 1e-3) return {xyz[0], xyz[1], xyz[2]};
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

}  // namespace

void answer_rows(const BatchEval& answer, int channels, RowFormat format) {
  RowReader in(STDIN_FILENO, format, row_numbers);
  RowWriter out(format, static_cast<std::size_t>(channels));
  std::vector<float> rows(block_rows * row_numbers), values(block_rows * static_cast<std::size_t>(channels));
  std::vector<Vec3f> wi(block_rows), wo(block_rows);
  while (const std::size_t n = in.read(rows)) {
    for (std::size_t i = 0; i < n; ++i) {
      wi[i] = unit(rows.data() + i * row_numbers);
      wo[i] = unit(rows.data() + i * row_numbers + 3);
    }
    const std::span<float> written = std::span(values).first(n * static_cast<std::size_t>(channels));
    answer(std::span(wi).first(n), std::span(wo).first(n), written);
    out.write(written);
  }
  out.flush();
}

}  // namespace brdf::cli
