// SPDX-License-Identifier: Apache-2.0
#include "ingest/tensor_file.h"

#include <brdf/error.h>

#include "base/byte_reader.h"
#include "base/checked.h"
#include "base/file_magic.h"
#include "ingest/printable_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brdf::ingest {
namespace {

constexpr std::uint16_t max_dimensions = 16;

struct TypeFacts {
  const char* name;
  std::size_t bytes;
};
constexpr TypeFacts type_facts[] = {{"u8", 1},  {"i8", 1},  {"u16", 2}, {"i16", 2}, {"u32", 4}, {"i32", 4},
                                    {"u64", 8}, {"i64", 8}, {"f16", 2}, {"f32", 4}, {"f64", 8}};

const TypeFacts& facts(TensorType type) noexcept { return type_facts[static_cast<std::size_t>(type) - 1]; }

std::string as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TensorType checked_type(std::uint8_t number, const std::string& where) {
  if (number < 1 || number > std::size(type_facts)) {
    throw Error(ErrorCode::malformed,
                where + " has element type " + std::to_string(number) + ", allowed are 1 (u8) to 11 (f64)");
  }
  return static_cast<TensorType>(number);
}

TensorField read_field(base::ByteReader& reader, std::span<const std::byte> file, const std::string& file_name) {
  TensorField field;
  field.name = as_text(reader.take(reader.read<std::uint16_t>("a field's name length"), "a field's name"));
  const std::string where = file_name + ": field " + in_quotes(field.name);

  const auto dimensions = reader.read<std::uint16_t>("a field's number of dimensions");
  if (dimensions > max_dimensions) {
    throw Error(ErrorCode::malformed, where + " has " + std::to_string(dimensions) + " dimensions, at most " +
                                          std::to_string(max_dimensions) + " are allowed");
  }
  field.type = checked_type(reader.read<std::uint8_t>("a field's element type"), where);
  const auto offset = reader.read<std::uint64_t>("a field's data offset");
  for (std::uint16_t i = 0; i < dimensions; ++i) field.shape.push_back(reader.read<std::uint64_t>("a field's shape"));

  const auto count = base::checked_product(field.shape);
  const auto length = count ? base::checked_multiply(*count, bytes_of(field.type)) : std::nullopt;
  if (!length) {
    throw Error(ErrorCode::malformed,
                where + " has shape " + shape_text(field.shape) + ", whose size does not fit 64 bits");
  }
  if (!base::range_fits(offset, *length, file.size())) {
    throw Error(ErrorCode::truncated, where + " needs " + std::to_string(*length) + " bytes from byte " +
                                          std::to_string(offset) + " on, the file has " + std::to_string(file.size()) +
                                          " bytes");
  }
  field.count = *count;
  field.bytes = file.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(*length));
  return field;
}

}  // namespace

const char* to_string(TensorType type) noexcept { return facts(type).name; }

std::size_t bytes_of(TensorType type) noexcept { return facts(type).bytes; }

std::string shape_text(std::span<const std::uint64_t> shape) {
  if (shape.empty()) return "of a single value";
  std::string text;
  for (const std::uint64_t extent : shape) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text;
}

TensorFile::TensorFile(std::span<const std::byte> bytes, std::string name, const IngestLimits& limits)
    : name_(std::move(name)), limits_(limits) {
  base::ByteReader reader(bytes, name_);
  if (as_text(reader.take(base::tensor_file_magic.size(), "the magic of a tensor file")) != base::tensor_file_magic) {
    throw Error(ErrorCode::not_recognized, name_ + ": is not a tensor file, its first bytes differ");
  }
  const auto major = reader.read<std::uint8_t>("the version"), minor = reader.read<std::uint8_t>("the version");
  if (major != 1 || minor != 0) {
    throw Error(ErrorCode::unsupported, name_ + ": is a tensor file of version " + std::to_string(major) + "." +
                                            std::to_string(minor) + ", only 1.0 is supported");
  }
  const auto count = reader.read<std::uint32_t>("the number of fields");
  if (count > limits_.max_fields) {
    throw Error(ErrorCode::limit_exceeded, name_ + ": the tensor file has " + std::to_string(count) +
                                               " fields, the limit is " + std::to_string(limits_.max_fields));
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    TensorField field = read_field(reader, bytes, name_);
    if (find(field.name)) {
      throw Error(ErrorCode::malformed, name_ + ": field " + in_quotes(field.name) + " appears twice");
    }
    fields_.push_back(std::move(field));
  }
}

const TensorField* TensorFile::find(std::string_view field) const noexcept {
  const auto at = std::find_if(fields_.begin(), fields_.end(), [&](const TensorField& f) { return f.name == field; });
  return at == fields_.end() ? nullptr : &*at;
}

const TensorField& TensorFile::require(std::string_view field, TensorType type, std::size_t dimensions) const {
  const TensorField* found = find(field);
  const std::string where = name_ + ": field " + in_quotes(field);
  if (!found) throw Error(ErrorCode::malformed, where + " is missing");
  if (found->type != type) {
    throw Error(ErrorCode::malformed,
                where + " has element type " + to_string(found->type) + ", expected " + to_string(type));
  }
  if (found->shape.size() != dimensions) {
    throw Error(ErrorCode::malformed, where + " has " + std::to_string(found->shape.size()) + " dimensions, expected " +
                                          std::to_string(dimensions));
  }
  return *found;
}

std::vector<float> TensorFile::read_floats(const TensorField& field) const {
  const std::string where = name_ + ": field " + in_quotes(field.name);
  if (field.count > limits_.max_table_values) {
    throw Error(ErrorCode::limit_exceeded, where + " has " + std::to_string(field.count) + " values, the limit is " +
                                               std::to_string(limits_.max_table_values));
  }
  std::vector<float> values(static_cast<std::size_t>(field.count));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = base::load_little_endian<float>(field.bytes.subspan(4 * i, 4));
    if (!std::isfinite(values[i])) {
      throw Error(ErrorCode::malformed,
                  where + " is not finite at index " + std::to_string(i) + " of " + std::to_string(values.size()));
    }
  }
  return values;
}

}  // namespace brdf::ingest
