// SPDX-License-Identifier: Apache-2.0
// Pictures in files: OpenEXR in and out, PNG out.
#pragma once

#include "image/image.h"
#include "image/raster.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>

namespace brdf::render {

/// What a picture says about itself: attributes of the EXR file, by name. Names are 1 to 31 characters and none of those
/// that OpenEXR gives a meaning of its own ("channels", "compression", ...).
using Metadata = std::map<std::string, std::variant<std::string, float>>;

/// What read_image accepts.
struct ReadLimits {
  std::uint64_t max_file_bytes = std::uint64_t{2} << 30;
  int max_side = 32768;                                  ///< of the display window and of the data window
  std::uint64_t max_pixels = std::uint64_t{1} << 27;     ///< 16384 x 8192: 1.5 GiB in memory
};

/// Reads an OpenEXR file, which is recognised by its content: scan lines or tiles, any compression, channels R, G, B (alpha
/// and others are ignored) or Y alone, each half or float. The picture is the file's display window; where the data
/// window leaves a part of it free, it is black, and what lies outside is dropped. Negative values are kept.
/// `metadata`, if given, receives the file's text and float attributes.
/// Throws Error with the path: io, not_recognized (no EXR file), truncated, malformed (also a value that is not finite, with
/// its pixel), limit_exceeded, unsupported (several parts, deep data, subsampled chroma, other primaries than BT.709's).
/// Thread-safe.
Image read_image(const std::filesystem::path& path, const ReadLimits& limits = {}, Metadata* metadata = nullptr);

enum class ExrPixels {
  half,     ///< 11 bits of precision; values beyond +-65504 are written as that
  float32,  ///< what is in memory, bit for bit
};

/// Writes channels R, G, B, ZIP-compressed, with BT.709's primaries and `metadata` as attributes. The file at `path` is the
/// old one or the whole new one at any time; the bytes depend on the arguments alone.
/// Throws Error: invalid_argument (empty picture, name of an attribute), io. Thread-safe.
void write_exr(const Image& image, const std::filesystem::path& path, const Metadata& metadata = {},
               ExrPixels pixels = ExrPixels::float32, bool overwrite = true);

/// The picture for a display: radiance times 2^exposure_stops, clipped to [0, 1], sRGB's transfer function, 8 bits, not
/// dithered, so equal pixels stay equal. NaN becomes black.
Raster developed(const Image& image, float exposure_stops);

/// Writes developed(image, exposure_stops) with the chunk that says sRGB, as atomically as write_exr.
/// Throws Error: invalid_argument (empty picture, exposure that is not finite), io. Thread-safe.
void write_png(const Image& image, const std::filesystem::path& path, float exposure_stops, bool overwrite = true);

/// The same for pixels that are encoded already.
void write_png(const Raster& raster, const std::filesystem::path& path, bool overwrite = true);

}  // namespace brdf::render
