// SPDX-License-Identifier: Apache-2.0
// Writes tensor files, sound ones and broken ones.
#pragma once

#include "base/byte_reader.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace brdf::test {

/// One field; what the directory says about it can be made to lie.
struct TensorFieldSpec {
  std::string name;
  std::uint8_t type = 10;  ///< f32
  std::vector<std::uint64_t> shape;
  std::vector<std::byte> data;
  std::optional<std::uint64_t> stated_offset;
};

inline void append_text(std::vector<std::byte>& out, const std::string& text) {
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

template <class T>
void append(std::vector<std::byte>& out, T value) {
  out.resize(out.size() + sizeof(T));
  base::store_little_endian(value, std::span(out).last(sizeof(T)));
}

template <class T>
std::vector<std::byte> to_bytes(const std::vector<T>& values) {
  std::vector<std::byte> out;
  out.reserve(values.size() * sizeof(T));
  for (const T v : values) append(out, v);
  return out;
}

class TensorFileBuilder {
 public:
  std::uint8_t major = 1, minor = 0;
  std::optional<std::uint32_t> stated_count;

  TensorFileBuilder& add(TensorFieldSpec field) {
    fields_.push_back(std::move(field));
    return *this;
  }
  TensorFileBuilder& floats(const std::string& name, std::vector<std::uint64_t> shape,
                            const std::vector<float>& values) {
    return add({name, 10, std::move(shape), to_bytes(values), std::nullopt});
  }
  TensorFileBuilder& text(const std::string& name, const std::string& value) {
    std::vector<std::byte> data;
    append_text(data, value);
    return add({name, 1, {value.size()}, data, std::nullopt});
  }

  /// The field of that name, to change it.
  TensorFieldSpec& field(const std::string& name) {
    for (TensorFieldSpec& f : fields_) {
      if (f.name == name) return f;
    }
    return fields_.emplace_back(TensorFieldSpec{name, 10, {}, {}, std::nullopt});
  }
  void set_floats(const std::string& name, std::vector<std::uint64_t> shape, const std::vector<float>& values) {
    TensorFieldSpec& f = field(name);
    f.shape = std::move(shape);
    f.data = to_bytes(values);
  }
  void remove(const std::string& name) {
    std::erase_if(fields_, [&](const TensorFieldSpec& f) { return f.name == name; });
  }

  std::vector<std::byte> build() const {
    std::uint64_t offset = 18;
    for (const TensorFieldSpec& f : fields_) offset += 13 + f.name.size() + 8 * f.shape.size();
    std::vector<std::byte> out;
    append_text(out, std::string("tensor_file\0", 12));
    append(out, major);
    append(out, minor);
    append(out, stated_count.value_or(static_cast<std::uint32_t>(fields_.size())));
    for (const TensorFieldSpec& f : fields_) {
      append(out, static_cast<std::uint16_t>(f.name.size()));
      append_text(out, f.name);
      append(out, static_cast<std::uint16_t>(f.shape.size()));
      append(out, f.type);
      append(out, f.stated_offset.value_or(offset));
      for (const std::uint64_t extent : f.shape) append(out, extent);
      offset += f.data.size();
    }
    for (const TensorFieldSpec& f : fields_) out.insert(out.end(), f.data.begin(), f.data.end());
    return out;
  }

 private:
  std::vector<TensorFieldSpec> fields_;
};

/// A small sound material: 2 elevations (0, 60 degrees), 2 x 2 densities of ones, 3 x 3 values where channel c of row y,
/// column x of elevation t is 100 t + 10 y + x + c / 10, jacobian off: f cos(theta_o) is the value at (u, v) itself.
inline TensorFileBuilder small_rgl_material() {
  const std::vector<float> ones4(4, 1.0f), ones8(8, 1.0f);
  std::vector<float> rgb;
  for (int t = 0; t < 2; ++t) {
    for (int c = 0; c < 3; ++c) {
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) rgb.push_back(static_cast<float>(100 * t + 10 * y + x + c / 10.0));
      }
    }
  }
  TensorFileBuilder b;
  b.text("description", "a test");
  b.floats("phi_i", {1}, {0.0f});
  b.floats("theta_i", {2}, {0.0f, 1.04719755f});
  b.floats("sigma", {2, 2}, ones4);
  b.floats("ndf", {2, 2}, ones4);
  b.floats("vndf", {1, 2, 2, 2}, ones8);
  b.floats("rgb", {1, 2, 3, 3, 3}, rgb);
  b.add({"jacobian", 1, {1}, {std::byte{0}}, std::nullopt});
  return b;
}

}  // namespace brdf::test
