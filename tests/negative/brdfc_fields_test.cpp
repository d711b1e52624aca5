// SPDX-License-Identifier: Apache-2.0
// Files whose checksums are right and whose fields are not.
#include "container/bit_stream.h"
#include "container/content.h"
#include "support/brdfc_content.h"
#include "support/brdfc_parts.h"
#include "support/expect_error.h"

#include <brdf/material.h>

#include <gtest/gtest.h>

namespace brdf::container {
namespace {

using test::ChunkParts;
using test::expect_error;
using test::FileParts;

FileParts layered() { return test::parts_of(pack(test::layered_content())); }
FileParts spectral() { return test::parts_of(pack(test::spectral_content())); }

void read(const FileParts& parts, const DecodeLimits& limits = {}) { unpack(parts.build(), limits, false); }

void set_bits(std::byte& b, unsigned bits) { b |= static_cast<std::byte>(bits); }

TEST(BrdfcFields, PartsBuildTheSameFile) {
  for (const Content& c :
       {test::layered_content(), test::spectral_content(), test::scalar_content(), test::lobes_content()}) {
    const auto bytes = pack(c);
    ASSERT_EQ(test::parts_of(bytes).build(), bytes) << "or none of these tests tests what it says";
  }
}

TEST(BrdfcFields, OtherVersionsAreUnsupported) {
  for (const int version : {0, 2, 255}) {
    FileParts p = layered();
    p.version = static_cast<std::uint8_t>(version);
    expect_error(ErrorCode::unsupported, {"version", std::to_string(version).c_str()}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ReservedFlagsAreMalformed) {
  for (unsigned bit = 0; bit < 8; ++bit) {
    FileParts p = layered();
    p.flags = static_cast<std::uint8_t>(1U << bit);
    expect_error(ErrorCode::malformed, {"reserved"}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ReservedBitsOfTheComponentAreMalformed) {
  FileParts p = layered();
  set_bits(p.component[0], 0x80);
  expect_error(ErrorCode::malformed, {"reserved"}, [&] { read(p); });
  for (const unsigned bit : {0x20U, 0x40U, 0x80U}) {
    p = layered();
    set_bits(p.component[1], bit);
    expect_error(ErrorCode::malformed, {"reserved"}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ComponentsOfLaterVersionsAreUnsupported) {
  for (const unsigned bit : {0x01U, 0x02U, 0x08U, 0x10U}) {  // sides, axes
    FileParts p = layered();
    set_bits(p.component[0], bit);
    expect_error(ErrorCode::unsupported, {"component"}, [&] { read(p); });
  }
  FileParts p = layered();
  p.component[0] &= std::byte{0x9F};  // neither mirror-symmetric nor reciprocal
  expect_error(ErrorCode::unsupported, {"component"}, [&] { read(p); });
  for (unsigned transform = 3; transform < 8; ++transform) {
    p = layered();
    p.component[1] = static_cast<std::byte>(transform << 2);
    expect_error(ErrorCode::unsupported, {"channel transform", std::to_string(transform).c_str()}, [&] { read(p); });
  }
  for (const std::uint64_t n : {0U, 2U, 300U}) {
    p = layered();
    p.components = n;
    expect_error(ErrorCode::unsupported, {"components"}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ChannelCountMustFitItsModel) {
  FileParts p = layered();
  p.component[2] = std::byte{4};
  expect_error(ErrorCode::malformed, {"4 channels"}, [&] { read(p); });
  p.component[1] = static_cast<std::byte>(3);  // scalar
  p.component[2] = std::byte{3};
  expect_error(ErrorCode::malformed, {"3 channels"}, [&] { read(p); });
  p.component[2] = std::byte{0};
  expect_error(ErrorCode::limit_exceeded, {"0 channels", "1 to"}, [&] { read(p); });
}

TEST(BrdfcFields, WavelengthsMustAscendAndBeNumbers) {
  const auto with = [](std::size_t i, float nm) {
    FileParts p = spectral();
    base::store_little_endian(nm, std::span(p.component).subspan(4 + 4 * i, 4));
    return p;
  };
  EXPECT_NO_THROW(read(with(2, 501.0F)));
  for (const float nm :
       {450.0F, 449.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    expect_error(ErrorCode::malformed, {"wavelength 2"}, [&] { read(with(2, nm)); });
  expect_error(ErrorCode::malformed, {"wavelength 0"}, [&] { read(with(0, 0.0F)); });
  FileParts p = spectral();
  p.component[3] = std::byte{2};
  expect_error(ErrorCode::unsupported, {"wavelengths"}, [&] { read(p); });
}

TEST(BrdfcFields, TotalMustBeTheSumOfTheChunks) {
  const auto size = layered().build().size();
  for (const std::uint64_t total : {size - 1, size + 1, std::size_t{0}, std::size_t{10000}}) {
    FileParts p = layered();
    p.stated_total = total;
    expect_error(ErrorCode::malformed, {"add up", std::to_string(total).c_str()}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ChunkCountMustFitTheDirectory) {
  FileParts p = layered();
  p.stated_chunks = 0;
  expect_error(ErrorCode::limit_exceeded, {"0 chunks"}, [&] { read(p); });
  for (const std::uint64_t n : {1U, 4U, 6U}) {
    p.stated_chunks = n;
    EXPECT_THROW(read(p), Error) << n;
  }
}

TEST(BrdfcFields, UnknownOptionalChunksAreSkipped) {
  const auto plain = pack(test::layered_content());
  const Unpacked expected = unpack(plain, {}, false);
  for (std::size_t place = 1; place <= 5; ++place) {
    FileParts p = layered();
    p.chunks.insert(p.chunks.begin() + static_cast<std::ptrdiff_t>(place),
                    ChunkParts{0x8F, {std::byte{1}, std::byte{2}}, std::nullopt});
    const Unpacked found = unpack(p.build(), {}, false);
    EXPECT_EQ(pack(found.content), plain) << place;
    EXPECT_EQ(found.refinements_read, expected.refinements_read);
    EXPECT_EQ(found.refinements_total, 3);
  }
}

TEST(BrdfcFields, UnknownCriticalChunksAreRefused) {
  for (int code = 0; code < 128; ++code) {
    if (code >= 1 && code <= 5) continue;
    FileParts p = layered();
    p.chunks.push_back({static_cast<std::uint8_t>(code), {std::byte{1}}, std::nullopt});
    expect_error(ErrorCode::unsupported, {"critical", std::to_string(code).c_str()}, [&] { read(p); });
  }
}

// A later version may give an optional chunk the number of a critical one: the whole code counts.
TEST(BrdfcFields, OptionalChunksAreNotTakenForCriticalOnes) {
  const auto plain = pack(test::layered_content());
  for (int code = 128; code < 256; ++code) {
    if (code == 0x89 || code == 0x8A || code == 0x8B) continue;
    FileParts p = layered();
    p.chunks.insert(p.chunks.begin() + 1, p.chunks[1]);
    p.chunks[1].code = static_cast<std::uint8_t>(code);
    const auto bytes = p.build();
    const Unpacked found = unpack(bytes, {}, false);
    EXPECT_EQ(found.refinements_total, 3) << code;
    EXPECT_EQ(pack(found.content), plain) << code;
    EXPECT_EQ(boundaries(bytes, {}).size(), 4U) << code;
  }
}

TEST(BrdfcFields, ChunksMustComeInTheirOrder) {
  const auto swapped = [](std::size_t a, std::size_t b) {
    FileParts p = layered();
    std::swap(p.chunks[a], p.chunks[b]);
    return p;
  };
  expect_error(ErrorCode::malformed, {"lobes"}, [&] { read(swapped(0, 1)); });
  expect_error(ErrorCode::malformed, {"without a residual"}, [&] { read(swapped(1, 2)); });
  FileParts p = layered();
  p.chunks.insert(p.chunks.begin() + 1, p.chunks[0]);
  expect_error(ErrorCode::malformed, {"second lobes"}, [&] { read(p); });
  p = layered();
  p.chunks.insert(p.chunks.begin() + 1, p.chunks[1]);
  expect_error(ErrorCode::malformed, {"residual"}, [&] { read(p); });
  p = layered();
  p.chunks.erase(p.chunks.begin(), p.chunks.begin() + 4);
  expect_error(ErrorCode::malformed, {"no lobes"}, [&] { read(p); });
}

TEST(BrdfcFields, LobesChunkMustEndWithItsLobes) {
  FileParts p = layered();
  p.chunks[0].payload.insert(p.chunks[0].payload.end(), 5, std::byte{1});
  expect_error(ErrorCode::malformed, {"left over"}, [&] { read(p); });
  p = layered();
  p.chunks[0].payload.resize(p.chunks[0].payload.size() / 2);
  expect_error(ErrorCode::malformed, {"lobes: "}, [&] { read(p); });
  p = layered();
  p.chunks[0].payload.resize(1);
  expect_error(ErrorCode::malformed, {"recorded errors"}, [&] { read(p); });
}

TEST(BrdfcFields, ReciprocalSlicesAreMalformed) {
  FileParts p = layered();
  set_bits(p.component[0], 0x04 | 0x40);
  expect_error(ErrorCode::malformed, {"slices", "reciprocal"}, [&] { read(p); });
}

TEST(BrdfcFields, ReservedBitsOfTheBasisAreMalformed) {
  for (unsigned bit = 0; bit < 3; ++bit) {
    FileParts p = layered();
    set_bits(p.chunks[1].payload[4 + 5], 1U << bit);  // 4 bytes of errors, 48 bits of basis; the last 3 are reserved
    expect_error(ErrorCode::malformed, {"reserved"}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ShortResidualChunksAreMalformed) {
  for (std::size_t size = 0; size < 10; ++size) {
    FileParts p = layered();
    p.chunks[1].payload.resize(size);
    expect_error(ErrorCode::malformed, {}, [&] { read(p); });
  }
}

TEST(BrdfcFields, ValuesThatCannotBeEvaluatedAreMalformed) {
  // the common exponent of the lobes at its largest: reflectances of 2^127
  FileParts p = layered();
  p.chunks[0].payload[2] |= std::byte{0x0F};
  p.chunks[0].payload[3] |= std::byte{0xF0};
  const auto bytes = p.build();
  expect_error(ErrorCode::malformed, {}, [&] { Material::decode(bytes); });
  // epsilon at its largest, 2^127: bits 17 to 24 after the errors
  p = layered();
  p.chunks[1].payload[4 + 2] |= std::byte{0x7F};
  p.chunks[1].payload[4 + 3] |= std::byte{0x80};
  const auto large_epsilon = p.build();
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    DecodeOptions options;
    options.level = level;
    expect_error(ErrorCode::malformed, {}, [&] { Material::decode(large_epsilon, options); });
  }
}

TEST(BrdfcFields, BrokenProvenanceIsAnError) {
  FileParts p = layered();
  p.chunks.back().payload[0] = std::byte{0x7F};  // a name longer than the chunk
  EXPECT_THROW(read(p), Error);
  p = layered();
  p.chunks.back().payload.pop_back();
  EXPECT_THROW(read(p), Error);
  p.chunks.back().payload.clear();
  EXPECT_THROW(read(p), Error);
}

}  // namespace
}  // namespace brdf::container
