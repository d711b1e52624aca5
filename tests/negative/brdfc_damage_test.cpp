// SPDX-License-Identifier: Apache-2.0
// Files that were cut, changed or lengthened after they were written.
#include "container/content.h"
#include "support/brdfc_content.h"
#include "support/expect_error.h"

#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace brdf::container {
namespace {

const DecodeLimits limits;

TEST(BrdfcDamage, EveryPrefixIsABoundaryOrAnError) {
  for (const Content& content : {test::layered_content(), test::spectral_content(), test::lobes_content()}) {
    const auto bytes = pack(content);
    const auto ends = boundaries(bytes, limits);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const auto prefix = std::span(bytes).first(n);
      const bool boundary = std::find(ends.begin(), ends.end(), n) != ends.end();
      try {
        const Unpacked read = unpack(prefix, limits, true);
        ASSERT_TRUE(boundary) << n << " bytes were taken for a coarser file";
        ASSERT_EQ(ends[static_cast<std::size_t>(read.refinements_read)], n);
      } catch (const Error& e) {
        ASSERT_FALSE(boundary) << n << ": " << e.what();
        const ErrorCode expected = n < 4 ? ErrorCode::not_recognized : ErrorCode::truncated;
        ASSERT_EQ(e.code(), expected) << n << ": " << e.what();
      }
      EXPECT_THROW(unpack(prefix, limits, false), Error) << n;
    }
  }
}

TEST(BrdfcDamage, EverySingleBitFlipIsAnError) {
  for (const Content& content : {test::layered_content(), test::spectral_content(), test::scalar_content()}) {
    auto bytes = pack(content);
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      const auto flip = static_cast<std::byte>(1U << (bit % 8));
      bytes[bit / 8] ^= flip;
      for (const bool allow_prefix : {false, true})
        ASSERT_THROW(unpack(bytes, limits, allow_prefix), Error) << "bit " << bit << " of byte " << bit / 8;
      bytes[bit / 8] ^= flip;
    }
    EXPECT_NO_THROW(unpack(bytes, limits, false));
  }
}

TEST(BrdfcDamage, FlipsInAPrefixAreErrorsToo) {
  auto bytes = pack(test::layered_content());
  bytes.resize(boundaries(bytes, limits)[1]);
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    const auto flip = static_cast<std::byte>(1U << (bit % 8));
    bytes[bit / 8] ^= flip;
    ASSERT_THROW(unpack(bytes, limits, true), Error) << "bit " << bit;
    bytes[bit / 8] ^= flip;
  }
  EXPECT_NO_THROW(unpack(bytes, limits, true));
}

TEST(BrdfcDamage, BytesAfterTheEndAreMalformed) {
  auto bytes = pack(test::layered_content());
  bytes.push_back(std::byte{0});
  for (const bool allow_prefix : {false, true})
    test::expect_error(ErrorCode::malformed,
                       {std::to_string(bytes.size()).c_str(), std::to_string(bytes.size() - 1).c_str()},
                       [&] { unpack(bytes, limits, allow_prefix); });
}

TEST(BrdfcDamage, BytesChangedBetweenChunksAreAChecksumError) {
  auto bytes = pack(test::layered_content());
  const auto ends = boundaries(bytes, limits);
  bytes[ends[0] + 4] ^= std::byte{0x10};
  test::expect_error(ErrorCode::checksum, {"residual", "damaged"}, [&] { unpack(bytes, limits, false); });
}

// The chain: a chunk of another file with a sound checksum of its own does not fit.
TEST(BrdfcDamage, ChunksOfAnotherFileDoNotFit) {
  Content other = test::layered_content();
  other.component.channels.model = ChannelModel::xyz;
  const auto a = pack(test::layered_content()), b = pack(other);
  const auto ends_a = boundaries(a, limits), ends_b = boundaries(b, limits);
  ASSERT_EQ(a.size(), b.size()) << "the case needs files of one layout";
  ASSERT_EQ(ends_a, ends_b);
  auto mixed = a;
  std::copy(b.begin() + static_cast<std::ptrdiff_t>(ends_b[0]), b.end(),
            mixed.begin() + static_cast<std::ptrdiff_t>(ends_a[0]));
  ASSERT_NE(mixed, a);
  test::expect_error(ErrorCode::checksum, {"residual"}, [&] { unpack(mixed, limits, false); });
}

TEST(BrdfcDamage, NoBytesAndOtherFormatsAreNotRecognized) {
  const std::string text = "MERL or whatever else";
  test::expect_error(ErrorCode::not_recognized, {"BRFC"}, [&] { unpack({}, limits, true); });
  test::expect_error(ErrorCode::not_recognized, {"BRFC"},
                     [&] { unpack(std::as_bytes(std::span(text.data(), text.size())), limits, true); });
}

TEST(BrdfcDamage, MaterialDecodeReportsTheSame) {
  auto bytes = pack(test::layered_content());
  const auto ends = boundaries(bytes, limits);
  DecodeOptions options;
  test::expect_error(ErrorCode::truncated, {}, [&] { Material::decode(std::span(bytes).first(ends[2]), options); });
  options.allow_prefix = true;
  const Material m = Material::decode(std::span(bytes).first(ends[2]), options);
  EXPECT_EQ(m.info().refinements_read, 2);
  EXPECT_EQ(m.info().refinements_total, 3);
  EXPECT_EQ(m.info().bytes, ends[2]);
  EXPECT_EQ(m.info().total_bytes, bytes.size());
  bytes.back() ^= std::byte{1};
  test::expect_error(ErrorCode::checksum, {"provenance"}, [&] { Material::decode(bytes, options); });
}

}  // namespace
}  // namespace brdf::container
