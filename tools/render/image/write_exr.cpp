// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"
#include "image/exr_stream.h"
#include "image/image_file.h"

#include <brdf/error.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <array>
#include <set>
#include <string>

namespace brdf::render {
namespace {

constexpr std::array<const char*, 3> channel_names{"R", "G", "B"};
constexpr std::size_t max_name_length = 31;  // of files that every version of OpenEXR reads

/// Attributes that tell OpenEXR how to read the file, or that write_exr sets.
bool is_reserved(const std::string& name) {
  static const std::set<std::string> reserved{
      "channels",  "chromaticities", "chunkCount", "compression",       "dataWindow",  "displayWindow", "envmap",
      "lineOrder", "maxSamplesPerPixel", "multiView", "name", "pixelAspectRatio", "preview", "screenWindowCenter",
      "screenWindowWidth", "tiles", "type", "version", "view"};
  return reserved.contains(name);
}

void add_metadata(Imf::Header& header, const Metadata& metadata, const std::filesystem::path& path) {
  for (const auto& [name, value] : metadata) {
    if (name.empty() || name.size() > max_name_length || name.find('\0') != std::string::npos || is_reserved(name)) {
      throw Error(ErrorCode::invalid_argument, path.string() + ": '" + name +
                                                   "' cannot be the name of an attribute (1 to 31 characters, none of "
                                                   "OpenEXR's own names)");
    }
    if (const float* number = std::get_if<float>(&value)) {
      header.insert(name, Imf::FloatAttribute(*number));
    } else {
      header.insert(name, Imf::StringAttribute(std::get<std::string>(value)));
    }
  }
}

std::vector<Imath::half> to_half(const Image& image) {
  constexpr float largest = 65504;
  std::vector<Imath::half> values;
  values.reserve(3 * image.pixels.size());
  for (const Vec3f& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      // ordered so that NaN passes: a broken pixel must not look like a bright one
      const float v = pixel[c];
      values.emplace_back(v > largest ? largest : v < -largest ? -largest : v);
    }
  }
  return values;
}

}  // namespace

void write_exr(const Image& image, const std::filesystem::path& path, const Metadata& metadata, ExrPixels pixels,
               bool overwrite) {
  if (image.pixels.empty()) throw Error(ErrorCode::invalid_argument, path.string() + ": a picture without pixels cannot be written");
  Imf::Header header(image.width, image.height, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  Imf::addChromaticities(header, Imf::Chromaticities());  // BT.709 is OpenEXR's default, said all the same
  add_metadata(header, metadata, path);

  const bool is_half = pixels == ExrPixels::half;
  const std::vector<Imath::half> halves = is_half ? to_half(image) : std::vector<Imath::half>();
  // OpenEXR's frame buffers serve reading, too, so they take writable memory.
  char* const first = is_half ? reinterpret_cast<char*>(const_cast<Imath::half*>(halves.data()))
                              : reinterpret_cast<char*>(const_cast<Vec3f*>(image.pixels.data()));
  const std::size_t value_bytes = is_half ? sizeof(Imath::half) : sizeof(float);
  const Imf::PixelType type = is_half ? Imf::HALF : Imf::FLOAT;
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(channel_names[c], Imf::Channel(type));
    frame.insert(channel_names[c], Imf::Slice(type, first + c * value_bytes, 3 * value_bytes,
                                              3 * value_bytes * static_cast<std::size_t>(image.width)));
  }
  ExrOutput stream;
  try {
    Imf::OutputFile file(stream, header, 0);  // 0: no threads of OpenEXR's own
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } catch (const Iex::BaseExc& e) {
    throw Error(ErrorCode::invalid_argument, path.string() + ": the EXR file could not be encoded: " + e.what());
  }
  base::write_file_atomically(path, stream.bytes(), overwrite);
}

}  // namespace brdf::render
