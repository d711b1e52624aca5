// SPDX-License-Identifier: Apache-2.0
#include <brdf/ingest.h>

#include "base/byte_reader.h"
#include "base/file_magic.h"
#include "ingest/merl_layout.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace brdf {
namespace {

bool starts_with(std::span<const std::byte> head, std::string_view magic) noexcept {
  return head.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), head.begin(), [](char a, std::byte b) { return std::byte(a) == b; });
}

/// Bytes that a text file in ASCII or UTF-8 may hold.
bool is_text(std::span<const std::byte> head) noexcept {
  return !head.empty() && std::all_of(head.begin(), head.end(), [](std::byte b) {
    const auto c = std::to_integer<unsigned char>(b);
    return c >= 0x20 ? c != 0x7f : (c == '\t' || c == '\n' || c == '\r' || c == '\f');
  });
}

bool looks_like_merl(std::span<const std::byte> head, std::uint64_t file_bytes) noexcept {
  using ingest::MerlLayout;
  // A table of exactly the right size is one with a bad header: the reader's message then names its fields.
  if (file_bytes == MerlLayout::file_bytes(MerlLayout::cells_half_circle) ||
      file_bytes == MerlLayout::file_bytes(MerlLayout::cells_full_circle)) {
    return true;
  }
  if (head.size() < MerlLayout::header_bytes) return false;
  std::array<std::int32_t, 3> n{};
  for (std::size_t i = 0; i < n.size(); ++i) n[i] = base::load_little_endian<std::int32_t>(head.subspan(4 * i, 4));
  return MerlLayout::dimensions_fit(n);
}

}  // namespace

FileFormat sniff(std::span<const std::byte> head, std::uint64_t file_bytes) noexcept {
  constexpr std::size_t enough = 512;
  head = head.first(std::min(head.size(), enough));
  if (starts_with(head, base::brdfc_magic)) return FileFormat::brdfc;
  if (starts_with(head, base::tensor_file_magic)) return FileFormat::rgl;
  if (starts_with(head, base::git_lfs_magic)) return FileFormat::git_lfs_pointer;
  if (looks_like_merl(head, file_bytes)) return FileFormat::merl;
  return is_text(head) ? FileFormat::text : FileFormat::unknown;
}

}  // namespace brdf
