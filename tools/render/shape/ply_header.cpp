// SPDX-License-Identifier: Apache-2.0
#include "shape/ply_header.h"

#include "ingest/printable_text.h"
#include "shape/mesh_text.h"

#include <brdf/error.h>

#include <array>
#include <utility>

namespace brdf::render {
namespace {

constexpr std::size_t max_elements = 64, max_properties = 256;

class HeaderReader {
 public:
  explicit HeaderReader(const std::string& name) : name_(name) {}

  PlyHeader read(std::string_view& text) {
    ++line_;
    if (take_line(text) != "ply") throw Error(ErrorCode::not_recognized, name_ + ": not a PLY file, which begins with 'ply'");
    bool has_format = false;
    for (;;) {
      if (text.empty()) throw Error(ErrorCode::truncated, name_ + ": the file ends before 'end_header'");
      ++line_;
      std::string_view line = take_line(text);
      const std::string_view key = take_word(line);
      if (key == "end_header") break;
      if (key.empty() || key == "comment" || key == "obj_info") continue;
      if (key == "format") {
        header_.encoding = encoding(take_word(line));
        has_format = true;
      } else if (key == "element") {
        element(line);
      } else if (key == "property") {
        property(line);
      } else {
        fail("unknown keyword " + ingest::in_quotes(key));
      }
    }
    if (!has_format) fail("the header has no 'format'");
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::malformed, name_ + ":" + std::to_string(line_) + ": " + what);
  }

  PlyEncoding encoding(std::string_view word) const {
    if (word == "ascii") return PlyEncoding::ascii;
    if (word == "binary_little_endian") return PlyEncoding::little_endian;
    if (word == "binary_big_endian") return PlyEncoding::big_endian;
    fail("format is " + ingest::in_quotes(word) + ", allowed is ascii, binary_little_endian or binary_big_endian");
  }

  PlyType type(std::string_view word) const {
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> names{{
        {"char", PlyType::i8}, {"int8", PlyType::i8}, {"uchar", PlyType::u8}, {"uint8", PlyType::u8},
        {"short", PlyType::i16}, {"int16", PlyType::i16}, {"ushort", PlyType::u16}, {"uint16", PlyType::u16},
        {"int", PlyType::i32}, {"int32", PlyType::i32}, {"uint", PlyType::u32}, {"uint32", PlyType::u32},
        {"float", PlyType::f32}, {"float32", PlyType::f32}, {"double", PlyType::f64}, {"float64", PlyType::f64},
    }};
    for (const auto& [known, meaning] : names)
      if (known == word) return meaning;
    fail("unknown type " + ingest::in_quotes(word));
  }

  void element(std::string_view line) {
    PlyElement e;
    e.name = take_word(line);
    const std::string_view word = take_word(line);
    const auto count = number_of<std::uint64_t>(word);
    if (!count) fail("element " + ingest::in_quotes(e.name) + " has the count " + ingest::in_quotes(word));
    e.count = *count;
    if (header_.elements.size() >= max_elements) fail("more than " + std::to_string(max_elements) + " elements");
    header_.elements.push_back(std::move(e));
  }

  void property(std::string_view line) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty p;
    std::string_view word = take_word(line);
    if (word == "list") {
      p.is_list = true;
      p.count_type = type(take_word(line));
      if (p.count_type == PlyType::f32 || p.count_type == PlyType::f64) fail("the count of a list must be an integer type");
      word = take_word(line);
    }
    p.type = type(word);
    p.name = take_word(line);
    auto& properties = header_.elements.back().properties;
    if (properties.size() >= max_properties) fail("more than " + std::to_string(max_properties) + " properties");
    properties.push_back(std::move(p));
  }

  std::string name_;
  std::size_t line_ = 0;
  PlyHeader header_;
};

}  // namespace

PlyHeader take_ply_header(std::string_view& text, const std::string& name) { return HeaderReader(name).read(text); }

}  // namespace brdf::render
