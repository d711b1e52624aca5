// SPDX-License-Identifier: Apache-2.0
#include "image/exr_header.h"
#include "image/exr_stream.h"

#include <brdf/error.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfVersion.h>
#include <cmath>

namespace brdf::render {
namespace {

constexpr std::size_t magic_bytes = 8;  // magic number and version

std::uint32_t little_endian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

int version_field(std::span<const std::byte> bytes) { return static_cast<int>(little_endian(bytes, 4)); }

/// Where the text that starts at `at` ends, which is its terminating zero.
std::size_t end_of_text(std::span<const std::byte> file, std::size_t at, const std::string& name) {
  constexpr std::size_t longest = 255;
  const std::size_t end = std::min(file.size(), at + longest + 1);
  for (std::size_t i = at; i < end; ++i) {
    if (file[i] == std::byte{0}) return i;
  }
  if (end == file.size()) throw Error(ErrorCode::truncated, name + ": the EXR header ends too early");
  throw Error(ErrorCode::malformed, name + ": the EXR header holds a name of more than 255 characters");
}

void check_attribute_sizes(std::span<const std::byte> file, const std::string& name) {
  std::size_t at = magic_bytes;
  while (true) {
    const std::size_t end = end_of_text(file, at, name);
    if (end == at) return;  // the empty name that ends the header
    const std::string attribute(reinterpret_cast<const char*>(file.data() + at), end - at);
    at = end_of_text(file, end + 1, name) + 1;
    if (file.size() < at + 4) throw Error(ErrorCode::truncated, name + ": the EXR header ends too early");
    const std::uint32_t size = little_endian(file, at);
    at += 4;
    if (size > file.size() - at) {
      throw Error(ErrorCode::truncated, name + ": the EXR attribute '" + attribute + "' has " + std::to_string(size) +
                                            " bytes, and " + std::to_string(file.size() - at) + " are left in the file");
    }
    at += size;
  }
}

std::int64_t side(int low, int high) { return static_cast<std::int64_t>(high) - low + 1; }

void check_window(const Imath::Box2i& window, const char* which, const ReadLimits& limits, const std::string& name) {
  const std::int64_t width = side(window.min.x, window.max.x), height = side(window.min.y, window.max.y);
  const std::string found = name + ": the EXR's " + which + " window is " + std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1) throw Error(ErrorCode::malformed, found + ", which holds no pixel");
  if (width > limits.max_side || height > limits.max_side || static_cast<std::uint64_t>(width * height) > limits.max_pixels) {
    throw Error(ErrorCode::limit_exceeded, found + ", at most " + std::to_string(limits.max_side) + " a side and " +
                                               std::to_string(limits.max_pixels) + " pixels are read");
  }
}

void check_primaries(const Imf::Header& header, const std::string& name) {
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities found = Imf::chromaticities(header), bt709;
  constexpr float tolerance = 0.005F;  // files round them to two or three digits
  for (const auto& [a, b] : {std::pair(found.red, bt709.red), std::pair(found.green, bt709.green),
                             std::pair(found.blue, bt709.blue), std::pair(found.white, bt709.white)}) {
    if (!((a - b).length() <= tolerance)) {
      throw Error(ErrorCode::unsupported, name + ": the EXR's primaries are not those of BT.709 (sRGB), the only ones that are read");
    }
  }
}

}  // namespace

void check_exr_magic(std::span<const std::byte> head, const std::string& name) {
  constexpr std::uint32_t magic = 20000630;
  if (head.size() < 4 || little_endian(head, 0) != magic) {
    throw Error(ErrorCode::not_recognized, name + ": this is not an OpenEXR file");
  }
  if (head.size() < magic_bytes) throw Error(ErrorCode::truncated, name + ": the EXR header ends too early");
  const int version = version_field(head);
  if ((version & Imf::VERSION_NUMBER_FIELD) != 2 || !Imf::supportsFlags(Imf::getFlags(version))) {
    throw Error(ErrorCode::unsupported, name + ": the EXR file is of a version that is not read, 2 is");
  }
  if (Imf::isMultiPart(version) || Imf::isNonImage(version)) {
    throw Error(ErrorCode::unsupported, name + ": the EXR file has several parts or deep data, only single flat pictures are read");
  }
}

Imf::Header read_exr_header(std::span<const std::byte> file, const std::string& name) {
  check_attribute_sizes(file, name);
  int version = version_field(file);
  ExrInput stream(file);
  stream.seekg(magic_bytes);
  Imf::Header header;
  try {
    header.readFrom(stream, version);
    header.sanityCheck(Imf::isTiled(version));
  } catch (const std::exception& e) {
    throw Error(ErrorCode::malformed, name + ": the EXR header is not valid (" + e.what() + ")");
  }
  return header;
}

ExrLayout checked_layout(const Imf::Header& header, const ReadLimits& limits, const std::string& name) {
  ExrLayout layout{header.displayWindow(), header.dataWindow()};
  check_window(layout.display, "display", limits, name);
  check_window(layout.data, "data", limits, name);
  if (header.hasTileDescription()) {
    const Imf::TileDescription& tiles = header.tileDescription();
    const std::uint32_t largest = static_cast<std::uint32_t>(limits.max_side);
    if (tiles.xSize < 1 || tiles.ySize < 1 || tiles.xSize > largest || tiles.ySize > largest) {
      throw Error(ErrorCode::limit_exceeded, name + ": the EXR's tiles are " + std::to_string(tiles.xSize) + " x " +
                                                 std::to_string(tiles.ySize) + ", at most " + std::to_string(largest) + " a side are read");
    }
  }

  const Imf::ChannelList& channels = header.channels();
  int count = 0;
  for (Imf::ChannelList::ConstIterator i = channels.begin(); i != channels.end(); ++i) ++count;
  constexpr int most_channels = 256;
  if (count > most_channels) {
    throw Error(ErrorCode::limit_exceeded, name + ": the EXR has " + std::to_string(count) + " channels, at most " +
                                               std::to_string(most_channels) + " are read");
  }
  const bool has_rgb = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
  layout.is_grey = !has_rgb && channels.findChannel("Y") && !channels.findChannel("RY") && !channels.findChannel("BY");
  if (!has_rgb && !layout.is_grey) {
    throw Error(ErrorCode::unsupported, name + ": the EXR has neither channels R, G and B nor Y alone");
  }
  for (const char* channel : {"R", "G", "B", "Y"}) {
    const Imf::Channel* const found = channels.findChannel(channel);
    if (found == nullptr || (channel[0] == 'Y') != layout.is_grey) continue;
    if (found->type != Imf::HALF && found->type != Imf::FLOAT) {
      throw Error(ErrorCode::unsupported, name + ": channel " + channel + " of the EXR is neither half nor float");
    }
    if (found->xSampling != 1 || found->ySampling != 1) {
      throw Error(ErrorCode::unsupported, name + ": channel " + channel + " of the EXR is subsampled");
    }
  }
  if (!layout.is_grey) check_primaries(header, name);
  return layout;
}

}  // namespace brdf::render
