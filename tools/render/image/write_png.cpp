// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"
#include "image/image_file.h"
#include "image/srgb.h"

#include <brdf/error.h>

#include <png.h>
#include <cmath>
#include <span>
#include <string>

namespace brdf::render {

Raster developed(const Image& image, float exposure_stops) {
  const double factor = std::exp2(static_cast<double>(exposure_stops));
  Raster raster(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      raster.pixels[i][static_cast<std::size_t>(c)] = srgb_code(factor * static_cast<double>(image.pixels[i][c]));
    }
  }
  return raster;
}

void write_png(const Raster& raster, const std::filesystem::path& path, bool overwrite) {
  if (raster.pixels.empty()) throw Error(ErrorCode::invalid_argument, path.string() + ": a picture without pixels cannot be written");
  // libpng's simplified interface: it reports failure by a return value and so never jumps over destructors. 8-bit RGB
  // without further flags is sRGB to it, and it writes that chunk.
  ::png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(raster.width);
  png.height = static_cast<png_uint_32>(raster.height);
  png.format = PNG_FORMAT_RGB;
  ::png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::byte> bytes(size);
  if (::png_image_write_to_memory(&png, bytes.data(), &size, 0, raster.pixels.data(), 0, nullptr) == 0) {
    throw Error(ErrorCode::io, path.string() + ": the PNG could not be encoded: " + static_cast<const char*>(png.message));
  }
  base::write_file_atomically(path, std::span<const std::byte>(bytes).first(size), overwrite);
}

void write_png(const Image& image, const std::filesystem::path& path, float exposure_stops, bool overwrite) {
  if (!std::isfinite(exposure_stops)) {
    throw Error(ErrorCode::invalid_argument, path.string() + ": the exposure must be a finite number of stops");
  }
  write_png(developed(image, exposure_stops), path, overwrite);
}

}  // namespace brdf::render
