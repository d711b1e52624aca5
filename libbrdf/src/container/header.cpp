// SPDX-License-Identifier: Apache-2.0
#include "container/header.h"

#include "base/byte_reader.h"
#include "base/file_magic.h"
#include "base/hash.h"
#include "container/chunk_types.h"
#include "container/varint.h"

#include <cstring>

namespace brdf::container {
namespace {

constexpr std::uint8_t wavelength_list = 1;

std::vector<std::byte> write_component(const Component& c) {
  std::vector<std::byte> out;
  const unsigned sides = (c.incident_below ? 1U : 0U) | (c.outgoing_below ? 2U : 0U);
  const unsigned parity = (c.mirror_symmetric ? 1U : 0U) | (c.reciprocal ? 2U : 0U);
  out.push_back(static_cast<std::byte>(sides | (static_cast<unsigned>(c.axes) << 2) | (parity << 5)));
  out.push_back(static_cast<std::byte>(static_cast<unsigned>(c.channels.model) | (static_cast<unsigned>(c.transform) << 2)));
  put_varint(out, static_cast<std::uint64_t>(c.channels.count));
  if (c.channels.model == ChannelModel::spectral) {
    out.push_back(std::byte{wavelength_list});
    for (const float nm : c.channels.wavelengths_nm) {
      std::byte raw[4];
      base::store_little_endian(nm, std::span<std::byte>(raw));
      out.insert(out.end(), raw, raw + 4);
    }
  }
  return out;
}

Component read_component(base::ByteReader& in, const DecodeLimits& limits) {
  Component c;
  const auto first = in.read<std::uint8_t>("the component");
  const auto second = in.read<std::uint8_t>("the component");
  c.incident_below = (first & 1U) != 0;
  c.outgoing_below = (first & 2U) != 0;
  const unsigned axes = (first >> 2) & 7U;
  c.mirror_symmetric = (first & 0x20U) != 0;
  c.reciprocal = (first & 0x40U) != 0;
  if ((first & 0x80U) != 0 || (second & 0xE0U) != 0) throw Error(ErrorCode::malformed, "component: reserved bits are set");
  if (axes >= axes_kind_count || c.incident_below || c.outgoing_below || (!c.mirror_symmetric && !c.reciprocal))
    throw Error(ErrorCode::unsupported, "component: axes " + std::to_string(axes) +
                                            " or its sides are not known to this version; only isotropic reflection with one symmetry at least is");
  c.axes = static_cast<AxesKind>(axes);
  if (c.axes == AxesKind::slices && c.reciprocal)
    throw Error(ErrorCode::malformed, "component: a residual in slices of theta_i cannot be reciprocal");
  c.channels.model = static_cast<ChannelModel>(second & 3U);
  const unsigned transform = (second >> 2) & 7U;
  if (transform >= static_cast<unsigned>(residual::channel_transform_count))
    throw Error(ErrorCode::unsupported, "component: channel transform " + std::to_string(transform) + " is not known to this version");
  c.transform = static_cast<residual::ChannelTransform>(transform);
  const std::uint64_t count = read_varint(in, "channel count");
  if (count == 0 || count > limits.max_channels)
    throw Error(ErrorCode::limit_exceeded, "component: " + std::to_string(count) + " channels, allowed are 1 to " + std::to_string(limits.max_channels));
  c.channels.count = static_cast<int>(count);
  const bool three = c.channels.model == ChannelModel::rgb || c.channels.model == ChannelModel::xyz;
  if ((three && count != 3) || (c.channels.model == ChannelModel::scalar && count != 1))
    throw Error(ErrorCode::malformed, "component: " + std::to_string(count) + " channels do not fit its channel model");
  if (c.channels.model == ChannelModel::spectral) {
    if (in.read<std::uint8_t>("wavelengths") != wavelength_list)
      throw Error(ErrorCode::unsupported, "component: this form of wavelengths is not known to this version");
    for (std::uint64_t i = 0; i < count; ++i) {
      const auto nm = in.read<float>("wavelengths");
      if (!(nm > 0 && nm < 1e7F) || (i > 0 && !(nm > c.channels.wavelengths_nm.back())))
        throw Error(ErrorCode::malformed, "component: wavelength " + std::to_string(i) + " is not above the one before it");
      c.channels.wavelengths_nm.push_back(nm);
    }
  }
  return c;
}

}  // namespace

std::uint32_t chain(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
  return XXH32(bytes.data(), bytes.size(), before);
}

std::vector<std::byte> write_header(const Component& component, const std::vector<DirectoryEntry>& directory) {
  std::vector<std::byte> tail;
  put_varint(tail, 1);  // components
  const std::vector<std::byte> declared = write_component(component);
  tail.insert(tail.end(), declared.begin(), declared.end());
  put_varint(tail, directory.size());
  std::uint64_t payload = 0;
  for (const DirectoryEntry& e : directory) {
    tail.push_back(static_cast<std::byte>(e.code));
    put_varint(tail, e.length);
    payload += e.length + checksum_bytes;
  }
  const std::uint64_t fixed = base::brdfc_magic.size() + 2 + tail.size() + checksum_bytes + payload;
  std::uint64_t total = fixed + 1;  // the total length counts its own bytes
  while (fixed + varint_bytes(total) != total) total = fixed + varint_bytes(total);
  std::vector<std::byte> out;
  for (const char ch : base::brdfc_magic) out.push_back(static_cast<std::byte>(ch));
  out.push_back(std::byte{format_version});
  out.push_back(std::byte{0});
  put_varint(out, total);
  out.insert(out.end(), tail.begin(), tail.end());
  std::byte raw[checksum_bytes];
  base::store_little_endian(chain(out, 0), std::span<std::byte>(raw));
  out.insert(out.end(), raw, raw + checksum_bytes);
  return out;
}

Header read_header(std::span<const std::byte> bytes, const DecodeLimits& limits) {
  const std::string_view magic = base::brdfc_magic;
  if (bytes.size() < magic.size() || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    throw Error(ErrorCode::not_recognized, "not a .brdfc file: it does not begin with \"" + std::string(magic) + "\"");
  if (bytes.size() > limits.max_file_bytes)
    throw Error(ErrorCode::limit_exceeded, ".brdfc file of " + std::to_string(bytes.size()) + " bytes, the limit is " +
                                               std::to_string(limits.max_file_bytes));
  base::ByteReader in(bytes, ".brdfc file");
  in.take(magic.size(), "the magic");
  const auto version = in.read<std::uint8_t>("the version");
  if (version != format_version)
    throw Error(ErrorCode::unsupported, ".brdfc format version " + std::to_string(version) + ", this library reads version " +
                                            std::to_string(format_version));
  if (in.read<std::uint8_t>("the flags") != 0) throw Error(ErrorCode::malformed, ".brdfc header: reserved flags are set");
  Header h;
  h.total_bytes = read_varint(in, ".brdfc header: total length");
  if (h.total_bytes > limits.max_file_bytes)
    throw Error(ErrorCode::limit_exceeded, ".brdfc header: a total of " + std::to_string(h.total_bytes) +
                                               " bytes is declared, the limit is " + std::to_string(limits.max_file_bytes));
  const std::uint64_t components = read_varint(in, ".brdfc header: component count");
  if (components != 1)
    throw Error(ErrorCode::unsupported, ".brdfc header: " + std::to_string(components) + " components, this version reads files with one");
  h.component = read_component(in, limits);
  const std::uint64_t chunks = read_varint(in, ".brdfc header: chunk count");
  if (chunks == 0 || chunks > limits.max_refinements + 4U)
    throw Error(ErrorCode::limit_exceeded, ".brdfc header: " + std::to_string(chunks) + " chunks, allowed are 1 to " +
                                               std::to_string(limits.max_refinements + 4U));
  std::uint64_t total = 0;
  for (std::uint64_t i = 0; i < chunks; ++i) {
    DirectoryEntry e;
    e.code = in.read<std::uint8_t>("the chunk directory");
    e.length = read_varint(in, ".brdfc header: chunk length");
    if (e.length > limits.max_file_bytes)
      throw Error(ErrorCode::limit_exceeded, ".brdfc header: chunk " + std::to_string(i) + " of " + std::to_string(e.length) +
                                                 " bytes, the limit is " + std::to_string(limits.max_file_bytes));
    total += e.length + checksum_bytes;
    h.directory.push_back(e);
  }
  h.checksum = chain(bytes.first(in.position()), 0);
  if (in.read<std::uint32_t>("the header's checksum") != h.checksum)
    throw Error(ErrorCode::checksum, ".brdfc header: checksum does not match, the file is damaged");
  h.header_bytes = in.position();
  if (total + h.header_bytes != h.total_bytes)
    throw Error(ErrorCode::malformed, ".brdfc header: the chunks add up to " + std::to_string(total + h.header_bytes) +
                                          " bytes, the total says " + std::to_string(h.total_bytes));
  return h;
}

}  // namespace brdf::container
