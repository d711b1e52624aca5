// SPDX-License-Identifier: Apache-2.0
// A `.brdfc` file taken to pieces and put together again, with any field made to lie and the checksums made to fit.
#pragma once

#include "base/byte_reader.h"
#include "base/hash.h"
#include "container/header.h"
#include "container/varint.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace brdf::test {

struct ChunkParts {
  std::uint8_t code = 0;
  std::vector<std::byte> payload;
  std::optional<std::uint64_t> stated_length;
};

struct FileParts {
  std::uint8_t version = 1, flags = 0;
  std::optional<std::uint64_t> stated_total, stated_chunks;
  std::uint64_t components = 1;
  std::vector<std::byte> component;  ///< the bytes of the declaration
  std::vector<ChunkParts> chunks;

  std::vector<std::byte> build() const;
};

inline std::uint32_t link(std::span<const std::byte> bytes, std::uint32_t seed) {
  return XXH32(bytes.data(), bytes.size(), seed);
}

inline void append_checksum(std::vector<std::byte>& out, std::uint32_t v) {
  out.resize(out.size() + 4);
  base::store_little_endian(v, std::span(out).last(4));
}

inline std::vector<std::byte> FileParts::build() const {
  std::vector<std::byte> tail;
  container::put_varint(tail, components);
  tail.insert(tail.end(), component.begin(), component.end());
  container::put_varint(tail, stated_chunks.value_or(chunks.size()));
  std::uint64_t after = 4;
  for (const ChunkParts& c : chunks) {
    tail.push_back(static_cast<std::byte>(c.code));
    container::put_varint(tail, c.stated_length.value_or(c.payload.size()));
    after += c.payload.size() + 4;
  }
  std::uint64_t total = 0;
  for (std::uint64_t width = 1; total == 0; ++width) {
    const std::uint64_t sum = 6 + width + tail.size() + after;
    if (container::varint_bytes(sum) == width) total = sum;
  }
  std::vector<std::byte> out;
  for (const char ch : {'B', 'R', 'F', 'C'}) out.push_back(static_cast<std::byte>(ch));
  out.push_back(static_cast<std::byte>(version));
  out.push_back(static_cast<std::byte>(flags));
  container::put_varint(out, stated_total.value_or(total));
  out.insert(out.end(), tail.begin(), tail.end());
  std::uint32_t checksum = link(out, 0);
  append_checksum(out, checksum);
  for (const ChunkParts& c : chunks) {
    out.insert(out.end(), c.payload.begin(), c.payload.end());
    checksum = link(c.payload, checksum);
    append_checksum(out, checksum);
  }
  return out;
}

/// The pieces of a sound file with one component.
inline FileParts parts_of(std::span<const std::byte> bytes) {
  const container::Header header = container::read_header(bytes, {});
  base::ByteReader in(bytes, "parts");
  in.take(6, "the head");
  container::read_varint(in, "total");
  FileParts p;
  p.components = container::read_varint(in, "components");
  const std::size_t begin = in.position();
  in.take(2, "the component");
  const std::uint64_t channels = container::read_varint(in, "channels");
  if (header.component.channels.model == ChannelModel::spectral) in.take(1 + 4 * channels, "wavelengths");
  const auto declared = bytes.subspan(begin, in.position() - begin);
  p.component.assign(declared.begin(), declared.end());
  std::size_t at = header.header_bytes;
  for (const container::DirectoryEntry& e : header.directory) {
    const auto payload = bytes.subspan(at, e.length);
    p.chunks.push_back({e.code, {payload.begin(), payload.end()}, std::nullopt});
    at += e.length + 4;
  }
  return p;
}

}  // namespace brdf::test
