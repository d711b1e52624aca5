// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"
#include "image/exr_header.h"
#include "image/exr_stream.h"

#include <brdf/error.h>

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>

namespace brdf::render {
namespace {

/// A frame buffer that puts every row of the file into `row`, pixel by pixel.
Imf::FrameBuffer row_buffer(const ExrLayout& layout, std::vector<Vec3f>& row) {
  // OpenEXR adds x * stride to the base, x counted from the display window's origin and not from the row's first pixel.
  // The sum is done on integers because that base lies outside the row.
  const std::intptr_t base = reinterpret_cast<std::intptr_t>(row.data()) -
                             static_cast<std::intptr_t>(layout.data.min.x) * static_cast<std::intptr_t>(sizeof(Vec3f));
  Imf::FrameBuffer frame;
  const auto add = [&](const char* channel, std::size_t c) {
    char* const first = reinterpret_cast<char*>(base + static_cast<std::intptr_t>(c * sizeof(float)));
    frame.insert(channel, Imf::Slice(Imf::FLOAT, first, sizeof(Vec3f), 0));
  };
  if (layout.is_grey) {
    add("Y", 0);
  } else {
    add("R", 0);
    add("G", 1);
    add("B", 2);
  }
  return frame;
}

void check_finite(const Vec3f& pixel, std::size_t x, int y, const std::string& name) {
  if (std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z)) return;
  throw Error(ErrorCode::malformed, name + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is not a finite number");
}

Image read_pixels(Imf::InputFile& file, const ExrLayout& layout, const std::string& name) {
  Image image;
  image.width = layout.width();
  image.height = layout.height();
  const std::size_t width = static_cast<std::size_t>(image.width);
  // Reserved and not filled: memory that is never written costs nothing, so a short file that declares a huge picture
  // fails at its first missing row.
  image.pixels.reserve(width * static_cast<std::size_t>(image.height));
  std::vector<Vec3f> row(static_cast<std::size_t>(layout.data.max.x) - static_cast<std::size_t>(layout.data.min.x) + 1, Vec3f(0));
  file.setFrameBuffer(row_buffer(layout, row));
  const int first_x = std::max(layout.data.min.x, layout.display.min.x);
  const int last_x = std::min(layout.data.max.x, layout.display.max.x);
  for (int y = 0; y < image.height; ++y) {
    image.pixels.insert(image.pixels.end(), width, Vec3f(0));
    const int file_y = layout.display.min.y + y;
    if (file_y < layout.data.min.y || file_y > layout.data.max.y || first_x > last_x) continue;
    file.readPixels(file_y);
    for (int file_x = first_x; file_x <= last_x; ++file_x) {
      Vec3f pixel = row[static_cast<std::size_t>(file_x - layout.data.min.x)];
      if (layout.is_grey) pixel = Vec3f(pixel.x);
      const std::size_t x = static_cast<std::size_t>(file_x - layout.display.min.x);
      check_finite(pixel, x, y, name);
      image.pixels[image.pixels.size() - width + x] = pixel;
    }
  }
  return image;
}

Metadata metadata_of(const Imf::Header& header) {
  Metadata metadata;
  for (Imf::Header::ConstIterator i = header.begin(); i != header.end(); ++i) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute())) metadata[i.name()] = text->value();
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&i.attribute())) metadata[i.name()] = number->value();
  }
  return metadata;
}

}  // namespace

Image read_image(const std::filesystem::path& path, const ReadLimits& limits, Metadata* metadata) {
  const std::string name = path.string();
  const std::vector<std::byte> bytes = base::read_file(
      path, limits.max_file_bytes, [&](std::span<const std::byte> head, std::uint64_t) { check_exr_magic(head, name); });
  check_exr_magic(bytes, name);  // an empty file has no head to check
  const Imf::Header header = read_exr_header(bytes, name);
  const ExrLayout layout = checked_layout(header, limits, name);
  if (metadata != nullptr) *metadata = metadata_of(header);
  ExrInput stream(bytes);
  try {
    Imf::InputFile file(stream, 0);  // 0: no threads of OpenEXR's own
    return read_pixels(file, layout, name);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::limit_exceeded, name + ": there is not enough memory for the picture");
  } catch (const std::exception& e) {
    if (stream.ended_early()) throw Error(ErrorCode::truncated, name + ": the EXR's pixels end too early");
    throw Error(ErrorCode::malformed, name + ": the EXR's pixels cannot be decoded (" + e.what() + ")");
  }
}

}  // namespace brdf::render
