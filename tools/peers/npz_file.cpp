// SPDX-License-Identifier: Apache-2.0
#include "npz_file.h"

#include <brdf/error.h>

#include "base/byte_reader.h"
#include "base/file_io.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace brdf::peers {
namespace {

constexpr std::uint64_t max_archive_bytes = std::uint64_t{64} << 20, max_array_bytes = std::uint64_t{1} << 20;

struct CloseArchive {
  void operator()(zip_t* archive) const noexcept { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const noexcept { zip_fclose(entry); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;
using Entry = std::unique_ptr<zip_file_t, CloseEntry>;

Error failure(ErrorCode code, const std::string& where, const std::string& what) { return {code, where + ": " + what}; }

std::string text_of(zip_error_t& error) {
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

Archive open_archive(std::span<const std::byte> bytes, const std::string& name) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr) throw failure(ErrorCode::io, name, "cannot be read as an archive, " + text_of(error));
  Archive archive(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (!archive) {
    zip_source_free(source);  // the archive would have taken it
    throw failure(ErrorCode::malformed, name, "is no readable zip archive, " + text_of(error));
  }
  zip_error_fini(&error);
  if (zip_get_num_entries(archive.get(), 0) == 0)
    throw failure(ErrorCode::malformed, name, "is a zip archive of nothing");
  return archive;
}

/// Unpacked bytes of entry `index`.
std::vector<std::byte> unpack(zip_t* archive, std::uint64_t index, const std::string& name) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat_index(archive, index, 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0)
    throw failure(ErrorCode::malformed, name, "has no size in the archive");
  if (stat.size > max_array_bytes) {
    throw failure(
        ErrorCode::limit_exceeded, name,
        "has " + std::to_string(stat.size) + " bytes, at most " + std::to_string(max_array_bytes) + " are allowed");
  }
  const Entry entry(zip_fopen_index(archive, index, 0));
  if (!entry) throw failure(ErrorCode::malformed, name, std::string("cannot be unpacked, ") + zip_strerror(archive));
  std::vector<std::byte> bytes(stat.size);
  const zip_int64_t count = zip_fread(entry.get(), bytes.data(), bytes.size());
  // the checksum is compared by the read that meets the end
  std::byte behind{};
  const zip_int64_t rest = count < 0 ? count : zip_fread(entry.get(), &behind, 1);
  if (rest != 0 || static_cast<std::uint64_t>(count) != stat.size)
    throw failure(ErrorCode::malformed, name,
                  "cannot be unpacked, its bytes contradict size or checksum in the archive");
  return bytes;
}

/// The text behind "'key':" of the header, a Python dictionary.
std::string_view header_value(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return rest;
}

/// Values of a .npy file.
std::vector<float> parse_array(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::array magic{std::byte{0x93}, std::byte{'N'}, std::byte{'U'},
                             std::byte{'M'},  std::byte{'P'}, std::byte{'Y'}};
  if (bytes.size() < 12 || !std::equal(magic.begin(), magic.end(), bytes.begin()))
    throw failure(ErrorCode::malformed, name, "does not begin like a NumPy array");
  const bool long_header = bytes[6] != std::byte{1};  // version 1 has 16 bits of length, later ones 32
  const std::size_t begin = long_header ? 12 : 10;
  const std::uint32_t length = long_header ? base::load_little_endian<std::uint32_t>(bytes.subspan(8))
                                           : base::load_little_endian<std::uint16_t>(bytes.subspan(8));
  if (length > bytes.size() - begin)
    throw failure(ErrorCode::truncated, name, "ends within the header of its NumPy array");
  const std::string_view header(reinterpret_cast<const char*>(bytes.data()) + begin, length);
  const std::span<const std::byte> data = bytes.subspan(begin + length);

  const std::string_view type = header_value(header, "'descr':"), shape = header_value(header, "'shape':");
  const bool single = type.starts_with("'<f4'"), wide = type.starts_with("'<f8'");
  if (!single && !wide) throw failure(ErrorCode::unsupported, name, "is no array of '<f4' or '<f8'");
  std::uint64_t count = 0;
  const char* const end = shape.data() + shape.size();
  const auto number = shape.starts_with('(') ? std::from_chars(shape.data() + 1, end, count)
                                             : std::from_chars_result{end, std::errc::invalid_argument};
  if (number.ec != std::errc() || !std::string_view(number.ptr, end).starts_with(",)"))
    throw failure(ErrorCode::unsupported, name, "has a shape of other than one axis");
  const std::size_t size = single ? 4 : 8;
  if (count > max_array_bytes || data.size() != size * count) {
    throw failure(ErrorCode::truncated, name,
                  "holds " + std::to_string(data.size()) + " bytes, its shape says " + std::to_string(count) +
                      " numbers of " + std::to_string(size));
  }
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = data.subspan(i * size);
    values[i] = single ? base::load_little_endian<float>(at) : static_cast<float>(base::load_little_endian<double>(at));
  }
  return values;
}

}  // namespace

NpzFile::NpzFile(const std::filesystem::path& path) : path_(path), bytes_(base::read_file(path, max_archive_bytes)) {
  open_archive(bytes_, path_.string());
}

std::optional<std::vector<float>> NpzFile::floats(const std::string& name) const {
  const Archive archive = open_archive(bytes_, path_.string());
  const zip_int64_t index = zip_name_locate(archive.get(), (name + ".npy").c_str(), ZIP_FL_ENC_RAW);
  if (index < 0) return std::nullopt;
  const std::string place = path_.string() + ": " + name;
  return parse_array(unpack(archive.get(), static_cast<std::uint64_t>(index), place), place);
}

}  // namespace brdf::peers
