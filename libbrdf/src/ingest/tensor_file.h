// SPDX-License-Identifier: Apache-2.0
// The container of the RGL database: named arrays with shape and element type.
#pragma once

#include <brdf/limits.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brdf::ingest {

/// Numbers are those of the file.
enum class TensorType : std::uint8_t {
  u8 = 1,
  i8,
  u16,
  i16,
  u32,
  i32,
  u64,
  i64,
  f16,
  f32,
  f64,
};
const char* to_string(TensorType type) noexcept;
std::size_t bytes_of(TensorType type) noexcept;

/// One array. `count` (the product of the shape) elements lie inside the file.
struct TensorField {
  std::string name;
  TensorType type{};
  std::vector<std::uint64_t> shape;
  std::uint64_t count = 0;
  std::span<const std::byte> bytes;
};

/// Directory of a tensor file. Refers to the bytes given, which must outlive it.
class TensorFile {
 public:
  /// Reads and checks the whole directory; every field's data lie inside the bytes. `name` begins every message.
  /// Throws Error: not_recognized, unsupported (version), malformed, truncated, limit_exceeded.
  TensorFile(std::span<const std::byte> bytes, std::string name, const IngestLimits& limits);

  /// The field, or nullptr.
  const TensorField* find(std::string_view field) const noexcept;

  /// The field. Throws Error(malformed) when it is missing, has another type or another number of dimensions.
  const TensorField& require(std::string_view field, TensorType type, std::size_t dimensions) const;

  /// The elements of a f32 field, converted from little-endian, all finite. Throws Error: limit_exceeded before
  /// anything is allocated, malformed with the index of the first element that is not finite.
  std::vector<float> read_floats(const TensorField& field) const;

  const std::string& name() const noexcept { return name_; }

 private:
  std::string name_;
  IngestLimits limits_;
  std::vector<TensorField> fields_;
};

/// "2 x 128" for messages.
std::string shape_text(std::span<const std::uint64_t> shape);

}  // namespace brdf::ingest
