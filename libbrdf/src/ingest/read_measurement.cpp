// SPDX-License-Identifier: Apache-2.0
#include <brdf/error.h>
#include <brdf/ingest.h>

#include "base/file_io.h"
#include "base/hash.h"
#include "ingest/merl_reader.h"
#include "ingest/printable_text.h"
#include "ingest/rgl_reader.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace brdf {
namespace {

/// "folder/gold-paint_rgb.bsdf" -> "gold-paint".
std::string material_name(const std::string& file_name) {
  std::string stem = std::filesystem::path(file_name).stem().string();
  constexpr std::string_view suffix = "_rgb";
  if (stem.size() > suffix.size() && stem.ends_with(suffix)) stem.resize(stem.size() - suffix.size());
  return ingest::printable_text(stem);
}

std::string first_bytes(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte b : bytes.first(std::min<std::size_t>(bytes.size(), 12))) {
    char hex[4];
    std::snprintf(hex, sizeof hex, " %02x", std::to_integer<unsigned>(b));
    text += hex;
  }
  return text;
}

[[noreturn]] void refuse(FileFormat format, std::span<const std::byte> bytes, const std::string& name) {
  constexpr auto code = ErrorCode::not_recognized;
  switch (format) {
    case FileFormat::brdfc:
      throw Error(code, name + ": is a compressed material (.brdfc), a measured file is needed here");
    case FileFormat::git_lfs_pointer:
      throw Error(code, name + ": is a Git-LFS pointer and not the data; fetch the data with 'git lfs pull'");
    case FileFormat::text:
      throw Error(code,
                  name + ": is a text file; measured files that can be read are MERL tables and RGL tensor files");
    case FileFormat::merl:
    case FileFormat::rgl:
    case FileFormat::unknown: break;
  }
  throw Error(code, name + ": is no file that can be read (a MERL table or an RGL tensor file); its first bytes are" +
                        first_bytes(bytes));
}

}  // namespace

Measurement read_measurement(std::span<const std::byte> bytes, const std::string& name, const IngestOptions& options) {
  if (bytes.size() > options.limits.max_file_bytes) {
    throw Error(ErrorCode::limit_exceeded, name + ": the file has " + std::to_string(bytes.size()) +
                                               " bytes, the limit is " + std::to_string(options.limits.max_file_bytes));
  }
  if (bytes.empty()) throw Error(ErrorCode::truncated, name + ": the file is empty");

  Measurement m;
  if (options.limits.max_channels < static_cast<std::uint32_t>(m.channels.count)) {
    throw Error(ErrorCode::limit_exceeded, name + ": a measured RGB file has 3 channels, the limit is " +
                                               std::to_string(options.limits.max_channels));
  }
  const FileFormat format = sniff(bytes, bytes.size());
  if (format == FileFormat::merl) {
    m.table = ingest::read_merl(bytes, name, options);
    m.provenance.format = "MERL";
  } else if (format == FileFormat::rgl) {
    ingest::RglMaterial material = ingest::read_rgl(bytes, name, options);
    m.table = std::move(material.table);
    m.provenance.description = std::move(material.description);
    m.provenance.format = "RGL";
  } else {
    refuse(format, bytes, name);
  }
  m.provenance.name = material_name(name);
  m.provenance.content_hash = base::xxh3_64(bytes);
  m.provenance.file_bytes = bytes.size();
  return m;
}

Measurement read_measurement(const std::filesystem::path& file, const IngestOptions& options) {
  const std::string name = file.string();
  // what no reader takes is refused by its first bytes, however large it is
  const auto check_head = [&name](std::span<const std::byte> head, std::uint64_t file_bytes) {
    const FileFormat format = sniff(head, file_bytes);
    if (!head.empty() && format != FileFormat::merl && format != FileFormat::rgl) refuse(format, head, name);
  };
  const std::vector<std::byte> bytes = base::read_file(file, options.limits.max_file_bytes, check_head);
  return read_measurement(bytes, name, options);
}

}  // namespace brdf
