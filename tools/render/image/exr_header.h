// SPDX-License-Identifier: Apache-2.0
// What an EXR file says about its pixels, checked before anything is allocated for them.
#pragma once

#include "image/image_file.h"

#include <OpenEXR/ImfHeader.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace brdf::render {

/// The first bytes of a file: throws Error not_recognized unless they are OpenEXR's, truncated, or unsupported (another
/// version, several parts, deep data). `name` starts the sentence.
void check_exr_magic(std::span<const std::byte> head, const std::string& name);

/// Where each pixel of the picture comes from.
struct ExrLayout {
  Imath::Box2i display, data;
  bool is_grey = false;  ///< channel Y alone
  int width() const noexcept { return display.max.x - display.min.x + 1; }
  int height() const noexcept { return display.max.y - display.min.y + 1; }
};

/// Walks the attributes of the header and then lets OpenEXR read them. OpenEXR allocates what an attribute declares as its
/// size before it reads, so the sizes are compared with the file's first. Throws Error malformed, truncated.
Imf::Header read_exr_header(std::span<const std::byte> file, const std::string& name);

/// Throws Error limit_exceeded, malformed, unsupported when the pixels are not what read_image accepts.
ExrLayout checked_layout(const Imf::Header& header, const ReadLimits& limits, const std::string& name);

}  // namespace brdf::render
