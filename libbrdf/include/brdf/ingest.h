// SPDX-License-Identifier: Apache-2.0
/// @file ingest.h
/// Readers of measured files, chosen by content and not by extension.
#pragma once

#include <brdf/limits.h>
#include <brdf/measurement.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace brdf {

enum class FileFormat { unknown, brdfc, merl, rgl, git_lfs_pointer, text };

/// Recognises a format from the first bytes and the total size. Never throws.
FileFormat sniff(std::span<const std::byte> head, std::uint64_t file_bytes) noexcept;

struct IngestOptions {
  IngestLimits limits;
  SamplePosition position = SamplePosition::edge;  ///< for MERL tables
};

/// Reads any supported measured file. Throws Error: io, not_recognized, malformed, truncated, limit_exceeded,
/// unsupported, no_data. The sentence starts with the file's name.
Measurement read_measurement(const std::filesystem::path& file, const IngestOptions& options = {});

/// The same from memory; `name` stands for the file's name in messages and provenance.
Measurement read_measurement(std::span<const std::byte> bytes, const std::string& name, const IngestOptions& options = {});

}  // namespace brdf
