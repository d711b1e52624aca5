// SPDX-License-Identifier: Apache-2.0
#include "ingest/merl_reader.h"

#include "base/byte_reader.h"
#include "ingest/merl_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace brdf::ingest {
namespace {

std::array<std::int32_t, 3> read_dimensions(base::ByteReader& reader, const std::string& name) {
  std::array<std::int32_t, 3> n{};
  for (std::int32_t& bins : n) bins = reader.read<std::int32_t>("the three bin counts of a MERL table");
  if (!MerlLayout::dimensions_fit(n)) {
    throw Error(ErrorCode::malformed, name + ": MERL bin counts are " + std::to_string(n[0]) + " x " +
                                          std::to_string(n[1]) + " x " + std::to_string(n[2]) +
                                          ", allowed are 90 x 90 x 180 and 90 x 90 x 360 (or the same product)");
  }
  return n;
}

void check_size(std::uint64_t found, std::uint64_t expected, const std::string& name) {
  if (found == expected) return;
  const std::string sizes =
      "the MERL table needs " + std::to_string(expected) + " bytes, the file has " + std::to_string(found);
  throw Error(found < expected ? ErrorCode::truncated : ErrorCode::malformed, name + ": " + sizes);
}

}  // namespace

HalfDifferenceTable read_merl(std::span<const std::byte> bytes, const std::string& name, const IngestOptions& options) {
  base::ByteReader reader(bytes, name);
  const std::array<std::int32_t, 3> n = read_dimensions(reader, name);
  const std::size_t cells =
      static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
  check_size(bytes.size(), MerlLayout::file_bytes(cells), name);
  const std::uint64_t count = std::uint64_t{cells} * MerlLayout::channels;
  if (count > options.limits.max_table_values) {
    throw Error(ErrorCode::limit_exceeded, name + ": the table has " + std::to_string(count) +
                                               " values, the limit is " +
                                               std::to_string(options.limits.max_table_values));
  }

  const std::uint64_t memory = count * sizeof(float) + cells;
  if (memory > options.limits.max_temporary_bytes) {
    throw Error(ErrorCode::limit_exceeded, name + ": the table takes " + std::to_string(memory) + " bytes of memory, the limit is " +
                                               std::to_string(options.limits.max_temporary_bytes));
  }

  HalfDifferenceTable table;
  table.n_theta_h = n[0];
  table.n_theta_d = n[1];
  table.n_phi_d = n[2];
  table.full_circle = n[2] == 360;
  table.position = options.position;
  table.values.resize(cells * MerlLayout::channels);
  table.valid.assign(cells, 1);
  for (std::size_t channel = 0; channel < MerlLayout::channels; ++channel) {
    const std::span<const std::byte> plane = reader.take(cells * 8, "the planes of a MERL table");
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double f = base::load_little_endian<double>(plane.subspan(cell * 8, 8)) * MerlLayout::scale[channel];
      // written so that NaN fails it; the upper bound is what a float can hold
      if (f >= 0 && f <= double{std::numeric_limits<float>::max()}) {
        table.values[cell * MerlLayout::channels + channel] = static_cast<float>(f);
      } else {
        table.valid[cell] = 0;
      }
    }
  }
  if (std::find(table.valid.begin(), table.valid.end(), 1) == table.valid.end()) {
    throw Error(ErrorCode::no_data, name + ": none of the " + std::to_string(cells) +
                                        " cells of the MERL table holds three finite values that are at least 0");
  }
  return table;
}

}  // namespace brdf::ingest
