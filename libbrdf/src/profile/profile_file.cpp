// SPDX-License-Identifier: Apache-2.0
// Profile files; docs/profile_format.md describes every field.
#include "base/byte_reader.h"
#include "base/hash.h"

#include <brdf/error.h>
#include <brdf/profile.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf {
namespace {

constexpr std::array<char, 4> magic = {'B', 'R', 'P', 'F'};
constexpr std::uint8_t version = 1;
constexpr std::size_t checksum_bytes = 4;
constexpr std::size_t longest_name = 255;
constexpr std::array<std::uint8_t, 5> axes = {ProfileGrid::theta_h, ProfileGrid::theta_d, ProfileGrid::phi_d, ProfileGrid::phi_h,
                                              ProfileGrid::theta};
constexpr const char* axis_names[] = {"theta_h bins", "theta_d bins", "phi_d bins", "phi_h bins", "theta bins"};

bool is_name(std::string_view name) noexcept {
  return !name.empty() && name.size() <= longest_name &&
         std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
}

[[noreturn]] void malformed(const std::string& sentence) { throw Error(ErrorCode::malformed, "profile: " + sentence); }

class Writer {
 public:
  void number(std::uint64_t v) {
    for (; v >= 0x80; v >>= 7) out_.push_back(static_cast<std::byte>((v & 0x7F) | 0x80));
    out_.push_back(static_cast<std::byte>(v));
  }
  template <class T>
  void value(T v) {
    std::byte raw[sizeof(T)];
    base::store_little_endian(v, std::span<std::byte>(raw));
    out_.insert(out_.end(), raw, raw + sizeof(T));
  }
  void text(std::string_view s) {
    number(s.size());
    for (const char c : s) out_.push_back(static_cast<std::byte>(c));
  }
  std::vector<std::byte>& bytes() noexcept { return out_; }

 private:
  std::vector<std::byte> out_;
};

/// Up to ten bytes: all of 64 bits, unlike the lengths within a `.brdfc` file. Only the shortest form.
std::uint64_t number(base::ByteReader& in, const char* what) {
  std::uint64_t v = 0;
  for (int shift = 0; shift < 70; shift += 7) {
    const auto b = in.read<std::uint8_t>(what);
    if (shift == 63 && b > 1) break;
    v |= std::uint64_t{b & 0x7FU} << shift;
    if ((b & 0x80U) == 0) {
      if (b == 0 && shift > 0) break;
      return v;
    }
  }
  malformed(std::string(what) + " is not a number in its shortest form");
}

void write_material(Writer& out, const MaterialProfile& m) {
  for (const std::uint64_t n : m.operations) out.number(n);
  for (const std::uint64_t n : {m.first_hits, m.footprint, m.transmitted, m.contributions}) out.number(n);
  for (const std::uint64_t n : m.phi_h) out.number(n);
  for (const std::uint64_t n : m.theta_i) out.number(n);
  for (const std::uint64_t n : m.theta_o) out.number(n);
  std::uint64_t cells = 0;
  for (const std::uint64_t c : m.histogram) cells += c > 0 ? 1 : 0;
  out.number(cells);
  if (cells > 0)
    for (const float angle : {m.range_i.least, m.range_i.most, m.range_o.least, m.range_o.most}) out.value(angle);
  std::size_t next = 0;
  for (std::size_t i = 0; i < m.histogram.size(); ++i) {
    if (m.histogram[i] == 0) continue;
    out.number(i - next);
    out.number(m.histogram[i]);
    next = i + 1;
  }
}

ProfileRange read_range(base::ByteReader& in, const char* what) {
  const ProfileRange r{in.read<float>(what), in.read<float>(what)};
  const auto allowed = [](float angle) { return angle >= 0 && angle <= 1.5708F; };
  if (!allowed(r.least) || !allowed(r.most) || r.least > r.most) malformed(std::string(what) + " is no range of angles from 0 to pi/2");
  return r;
}

MaterialProfile read_material(base::ByteReader& in) {
  MaterialProfile m;
  for (std::uint64_t& n : m.operations) n = number(in, "the number of operations");
  m.first_hits = number(in, "the number of first hits");
  m.footprint = number(in, "the footprint");
  m.transmitted = number(in, "the transmitted contribution");
  m.contributions = number(in, "the number of contributions");
  for (std::uint64_t& n : m.phi_h) n = number(in, "the marginal of phi_h");
  for (std::uint64_t& n : m.theta_i) n = number(in, "the marginal of theta_i");
  for (std::uint64_t& n : m.theta_o) n = number(in, "the marginal of theta_o");
  const std::uint64_t cells = number(in, "the number of cells");
  if (cells > m.histogram.size())
    malformed("a material has " + std::to_string(cells) + " cells, at most " + std::to_string(m.histogram.size()) + " are allowed");
  if (cells > 0) {
    m.range_i = read_range(in, "the range of theta_i");
    m.range_o = read_range(in, "the range of theta_o");
  }
  std::uint64_t next = 0;
  for (std::uint64_t i = 0; i < cells; ++i) {
    const std::uint64_t gap = number(in, "the place of a cell"), value = number(in, "the contribution of a cell");
    if (gap >= m.histogram.size() - next) malformed("a cell lies beyond the last one");
    if (value == 0) malformed("a cell without any contribution is listed");
    m.histogram[static_cast<std::size_t>(next + gap)] = value;
    next += gap + 1;
  }
  return m;
}

}  // namespace

std::vector<std::byte> Profile::write() const {
  Writer out;
  for (const char c : magic) out.bytes().push_back(static_cast<std::byte>(c));
  out.value(version);
  for (const std::uint8_t n : axes) out.value(n);
  out.number(materials.size());
  for (const auto& [slot, asked] : materials) {
    if (!is_name(slot))
      throw Error(ErrorCode::invalid_argument,
                  "profile: '" + slot + "' is no name of a slot: 1 to 255 bytes without control characters are allowed");
    out.text(slot);
    write_material(out, asked);
  }
  out.value(base::xxh32(out.bytes()));
  return std::move(out.bytes());
}

Profile Profile::read(std::span<const std::byte> bytes, const ProfileLimits& limits) {
  if (bytes.size() > limits.max_file_bytes)
    throw Error(ErrorCode::limit_exceeded, "profile: the file has " + std::to_string(bytes.size()) + " bytes, at most " +
                                               std::to_string(limits.max_file_bytes) + " are allowed");
  base::ByteReader head(bytes, "profile");
  const auto begin = bytes.first(std::min(bytes.size(), magic.size()));
  if (begin.empty() || !std::equal(begin.begin(), begin.end(), magic.begin(), [](std::byte b, char c) { return b == static_cast<std::byte>(c); }))
    throw Error(ErrorCode::not_recognized, "profile: the file does not begin with BRPF, so it is no profile");
  head.take(magic.size(), "its first bytes");
  const auto found = head.read<std::uint8_t>("its version");
  if (found != version)
    throw Error(ErrorCode::unsupported, "profile: the file is of version " + std::to_string(found) + ", only 1 is known");
  head.take(axes.size() + 1 + checksum_bytes, "its header");

  const auto body = bytes.first(bytes.size() - checksum_bytes);
  if (base::xxh32(body) != base::load_little_endian<std::uint32_t>(bytes.last(checksum_bytes)))
    throw Error(ErrorCode::checksum, "profile: the checksum does not match, the file is damaged or cut short");
  base::ByteReader in(body, "profile");
  in.take(magic.size() + 1, "its header");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto n = in.read<std::uint8_t>(axis_names[i]);
    if (n != axes[i])
      throw Error(ErrorCode::unsupported, std::string("profile: ") + std::to_string(n) + " " + axis_names[i] + ", only " +
                                              std::to_string(axes[i]) + " are known");
  }
  const std::uint64_t count = number(in, "the number of materials");
  if (count > limits.max_materials)
    throw Error(ErrorCode::limit_exceeded, "profile: " + std::to_string(count) + " materials, at most " + std::to_string(limits.max_materials) + " are allowed");
  Profile p;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t length = number(in, "the length of a name");
    if (length > limits.max_name_bytes)
      throw Error(ErrorCode::limit_exceeded, "profile: a name of " + std::to_string(length) + " bytes, at most " + std::to_string(limits.max_name_bytes) + " are allowed");
    const auto text = in.take(length, "a name");
    std::string name;
    for (const std::byte b : text) name.push_back(static_cast<char>(b));
    if (!is_name(name)) malformed("the name of a material is empty or holds a control character");
    if (!p.materials.empty() && !(p.materials.rbegin()->first < name)) malformed("the names of the materials do not ascend");
    p.materials.emplace_hint(p.materials.end(), std::move(name), read_material(in));
  }
  if (in.remaining() != 0) malformed(std::to_string(in.remaining()) + " bytes follow the last material");
  return p;
}

}  // namespace brdf
