// SPDX-License-Identifier: Apache-2.0
// What a PLY file says of itself before its data.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace brdf::render {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;   ///< of the value, or of a list's values
  bool is_list = false;
  PlyType count_type = PlyType::u8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
};

constexpr std::size_t size_of(PlyType type) noexcept {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// Takes the header off `text`. Throws Error: not_recognized, malformed (with the line), truncated.
PlyHeader take_ply_header(std::string_view& text, const std::string& name);

}  // namespace brdf::render
