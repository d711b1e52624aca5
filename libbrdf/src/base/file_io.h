// SPDX-License-Identifier: Apache-2.0
// Whole files in and out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace brdf::base {

/// The bytes of a file (or of a pipe, up to its end). Nothing is allocated for a file that is larger than `max_bytes`.
/// Throws Error: io (missing, a directory, no permission, read error), limit_exceeded, truncated (the file shrank while
/// it was read). The sentence starts with the path.
///
/// `check_head`, if given, is called with the first bytes (512, or the whole of a shorter file) and the size (0 where a pipe
/// or device does not tell it) before the rest is read, and may throw.
using HeadCheck = std::function<void(std::span<const std::byte> head, std::uint64_t file_bytes)>;
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes, const HeadCheck& check_head = {});

/// Replaces or creates `path` so that other processes see the old file or the whole new one, never a part, and so that
/// the bytes are on the disk when it returns. A symbolic link is followed. The bytes have no name in the folder until
/// they are complete, so a killed process leaves no partial file either (file systems without O_TMPFILE get a temporary
/// file in the same folder, removed on failure). A device or pipe is written directly: nothing in it can be replaced.
/// Without `overwrite` an existing file is left alone and Error(io) is thrown, also when it appears meanwhile.
/// Throws Error(io) with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes, bool overwrite);

}  // namespace brdf::base
