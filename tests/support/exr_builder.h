// SPDX-License-Identifier: Apache-2.0
// EXR files of kinds that write_exr does not make, and broken ones, byte by byte.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace brdf::test {

/// Little-endian fields one after the other.
class ExrBytes {
 public:
  ExrBytes& u8(unsigned value) { return put(static_cast<std::uint8_t>(value)); }
  ExrBytes& i32(std::int64_t value) { return put(static_cast<std::uint32_t>(value)); }
  ExrBytes& u64(std::uint64_t value) { return put(value); }
  ExrBytes& f32(float value) { return put(value); }
  ExrBytes& text(const std::string& value) { bytes_ += value; return u8(0); }
  ExrBytes& raw(const std::string& value) { bytes_ += value; return *this; }
  ExrBytes& attribute(const std::string& name, const std::string& type, const std::string& value) {
    return text(name).text(type).i32(static_cast<std::int64_t>(value.size())).raw(value);
  }
  const std::string& bytes() const { return bytes_; }
  std::size_t size() const { return bytes_.size(); }

 private:
  template <class T>
  ExrBytes& put(T value) {
    char out[sizeof(T)];
    std::memcpy(out, &value, sizeof(T));
    bytes_.append(out, sizeof(T));
    return *this;
  }
  std::string bytes_;
};

struct ExrWindow {
  std::int64_t min_x, min_y, max_x, max_y;
};

struct ExrChannel {
  std::string name;
  int type = 2;  ///< 0 unsigned, 1 half, 2 float
  int x_sampling = 1, y_sampling = 1;
};

/// Magic number and header of an uncompressed file of scan lines.
struct ExrHeader {
  ExrWindow data{0, 0, 3, 1}, display{0, 0, 3, 1};
  std::vector<ExrChannel> channels{{"B"}, {"G"}, {"R"}};  ///< in alphabetical order, as OpenEXR demands
  int compression = 0;
  unsigned version = 2;
  std::string more;  ///< further attributes

  static std::string box(const ExrWindow& w) { return ExrBytes().i32(w.min_x).i32(w.min_y).i32(w.max_x).i32(w.max_y).bytes(); }
  std::string bytes() const {
    ExrBytes list;
    for (const ExrChannel& c : channels) list.text(c.name).i32(c.type).i32(0).i32(c.x_sampling).i32(c.y_sampling);
    list.u8(0);
    ExrBytes file;
    file.i32(20000630).i32(version);
    file.attribute("channels", "chlist", list.bytes());
    file.attribute("compression", "compression", std::string(1, static_cast<char>(compression)));
    file.attribute("dataWindow", "box2i", box(data)).attribute("displayWindow", "box2i", box(display));
    file.attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    file.attribute("pixelAspectRatio", "float", ExrBytes().f32(1).bytes());
    file.attribute("screenWindowCenter", "v2f", ExrBytes().f32(0).f32(0).bytes());
    file.attribute("screenWindowWidth", "float", ExrBytes().f32(1).bytes());
    return file.raw(more).u8(0).bytes();
  }
};

/// The whole file: in row y of channel c of float the value at x is value(c, x, y), coordinates as in the windows.
template <class Value>
std::string uncompressed_exr(const ExrHeader& header, Value&& value) {
  ExrBytes file;
  file.raw(header.bytes());
  const std::int64_t width = header.data.max_x - header.data.min_x + 1, height = header.data.max_y - header.data.min_y + 1;
  const std::int64_t row_bytes = width * 4 * static_cast<std::int64_t>(header.channels.size());
  const std::uint64_t first = file.size() + static_cast<std::uint64_t>(8 * height);
  for (std::int64_t row = 0; row < height; ++row) file.u64(first + static_cast<std::uint64_t>(row * (row_bytes + 8)));
  for (std::int64_t y = header.data.min_y; y <= header.data.max_y; ++y) {
    file.i32(y).i32(row_bytes);
    for (const ExrChannel& channel : header.channels) {
      for (std::int64_t x = header.data.min_x; x <= header.data.max_x; ++x) file.f32(value(channel.name, x, y));
    }
  }
  return file.bytes();
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace brdf::test
