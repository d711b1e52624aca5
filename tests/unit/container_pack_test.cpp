// SPDX-License-Identifier: Apache-2.0
#include "base/hash.h"
#include "container/content.h"
#include "container/header.h"
#include "container/varint.h"
#include "support/brdfc_content.h"
#include "support/expect_error.h"

#include <brdf/material.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace brdf::container {
namespace {

const DecodeLimits limits;

void expect_equal(const residual::ResidualCode& a, const residual::ResidualCode& b) {
  EXPECT_EQ(a.basis.kappa_h, b.basis.kappa_h);
  EXPECT_EQ(a.basis.kappa_d, b.basis.kappa_d);
  EXPECT_EQ(a.basis.window_h, b.basis.window_h);
  EXPECT_EQ(a.basis.window_d, b.basis.window_d);
  EXPECT_EQ(a.basis.epsilon, b.basis.epsilon);
  EXPECT_EQ(a.basis.shape, b.basis.shape);
  EXPECT_EQ(a.azimuth, b.azimuth);
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t i = 0; i < a.layers.size(); ++i) {
    EXPECT_EQ(a.layers[i].step, b.layers[i].step);
    EXPECT_EQ(a.layers[i].restart, b.layers[i].restart);
    EXPECT_EQ(a.layers[i].end, b.layers[i].end);
    EXPECT_EQ(a.layers[i].q, b.layers[i].q);
  }
}

void expect_equal(const Content& a, const Content& b) {
  EXPECT_EQ(a.component.channels.model, b.component.channels.model);
  EXPECT_EQ(a.component.channels.count, b.component.channels.count);
  EXPECT_EQ(a.component.channels.wavelengths_nm, b.component.channels.wavelengths_nm);
  EXPECT_EQ(a.component.reciprocal, b.component.reciprocal);
  EXPECT_EQ(a.component.mirror_symmetric, b.component.mirror_symmetric);
  EXPECT_EQ(a.component.transform, b.component.transform);
  ASSERT_EQ(a.lobes.lobes.size(), b.lobes.lobes.size());
  for (std::size_t i = 0; i < a.lobes.lobes.size(); ++i) {
    EXPECT_EQ(a.lobes.lobes[i].kind, b.lobes.lobes[i].kind);
    EXPECT_EQ(a.lobes.lobes[i].alpha, b.lobes.lobes[i].alpha);
    EXPECT_EQ(a.lobes.lobes[i].color, b.lobes.lobes[i].color);
  }
  if (!a.residual.empty() || !b.residual.empty()) expect_equal(a.residual, b.residual);
  ASSERT_EQ(a.provenance.has_value(), b.provenance.has_value());
  if (!a.provenance) return;
  EXPECT_EQ(a.provenance->name, b.provenance->name);
  EXPECT_EQ(a.provenance->format, b.provenance->format);
  EXPECT_EQ(a.provenance->description, b.provenance->description);
  EXPECT_EQ(a.provenance->licence, b.provenance->licence);
  EXPECT_EQ(a.provenance->content_hash, b.provenance->content_hash);
  EXPECT_EQ(a.provenance->file_bytes, b.provenance->file_bytes);
  EXPECT_EQ(a.fitter, b.fitter);
}

TEST(Pack, UnpackIsTheInverse) {
  for (const Content& content : {test::lobes_content(), test::layered_content(), test::layered_content(false),
                                 test::spectral_content(), test::scalar_content()}) {
    const auto bytes = pack(content);
    const Unpacked read = unpack(bytes, limits, false);
    expect_equal(content, read.content);
    EXPECT_EQ(read.total_bytes, bytes.size());
    EXPECT_EQ(read.refinements_total, static_cast<int>(content.residual.layers.size()));
    EXPECT_EQ(read.refinements_read, read.refinements_total);
    EXPECT_EQ(pack(read.content), bytes);
  }
}

TEST(Pack, XyzChannelsAndTexts) {
  Content c = test::layered_content();
  c.component.channels.model = ChannelModel::xyz;
  c.provenance->description = std::string(5000, 'x');
  c.provenance->name.clear();
  c.provenance->licence = std::string("a\0b", 3);
  const Content read = unpack(pack(c), limits, false).content;
  EXPECT_EQ(read.component.channels.model, ChannelModel::xyz);
  EXPECT_EQ(read.provenance->description, std::string(4096, 'x'));  // the format's longest text
  EXPECT_TRUE(read.provenance->name.empty());
  EXPECT_EQ(read.provenance->licence.size(), 3U);
}

TEST(Pack, RecordedErrorsAreKeptPerRefinementAndLevel) {
  const Content c = test::layered_content();
  const Unpacked read = unpack(pack(c), limits, false);
  ASSERT_EQ(read.content.errors.size(), c.errors.size());
  for (std::size_t i = 0; i < c.errors.size(); ++i) {
    const RecordedError &in = c.errors[i], &out = read.content.errors[i];
    EXPECT_EQ(out.refinement, in.refinement);
    EXPECT_EQ(out.level, in.level);
    EXPECT_GE(out.log_mae, in.log_mae);
    EXPECT_LE(out.log_mae, in.log_mae * 1.0906);
    EXPECT_LE(out.psnr_env, in.psnr_env);
    EXPECT_GT(out.psnr_env, in.psnr_env - 0.25);
  }
}

TEST(Pack, ErrorsThatNobodyMeasuredAreTheWorst) {
  Content c = test::layered_content();
  c.errors.clear();
  for (const RecordedError& e : unpack(pack(c), limits, false).content.errors) {
    EXPECT_GT(e.log_mae, 3.6);
    EXPECT_EQ(e.psnr_env, 0);
  }
}

TEST(Pack, LobesOnlyOverheadIsAtMost24Bytes) {
  Content c = test::lobes_content();
  c.lobes.lobes.clear();
  EXPECT_LE(pack(c).size(), 24 + 2U);  // 12 bits say that there is no lobe
  c = test::lobes_content();
  constexpr std::size_t lambert_bits = 3 + 33, ggx_bits = 3 + 22 + 33;
  EXPECT_LE(pack(c).size(), 24 + (4 + 8 + lambert_bits + 2 * ggx_bits + 7) / 8);
}

/// Sound but for one change.
template <class Change>
void expect_refused(const char* word, Change&& change) {
  Content c = test::layered_content();
  change(c);
  test::expect_error(ErrorCode::invalid_argument, {word}, [&] { pack(c); });
}

TEST(Pack, ContentsThatNobodyCouldReadAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  expect_refused("15 lobes", [](Content& c) { c.lobes.lobes.assign(16, c.lobes.lobes[0]); });
  expect_refused("channels", [](Content& c) { c.lobes.channels = 4; });
  expect_refused("channels", [](Content& c) { c.component.channels.count = 4; });
  expect_refused("one channel", [](Content& c) { c.component.channels.model = ChannelModel::scalar; });
  expect_refused("wavelength", [](Content& c) { c.component.channels.model = ChannelModel::spectral; });
  expect_refused("colours", [](Content& c) { c.lobes.lobes[1].color.pop_back(); });
  for (const double bad : {nan, inf, -0.1}) {
    expect_refused("colour", [bad](Content& c) { c.lobes.lobes[0].color[1] = bad; });
    expect_refused("f90", [bad](Content& c) { c.lobes.lobes[1].f90 = bad; });
    expect_refused("alpha", [bad](Content& c) { c.lobes.lobes[1].alpha = bad; });
  }
  expect_refused("symmetries", [](Content& c) { c.residual.azimuth = residual::Azimuth::one_way; });
  expect_refused("channels", [](Content& c) { c.residual.channels = 1; });
  expect_refused("basis", [](Content& c) { c.residual.basis.kappa_h = 32; });
  expect_refused("basis", [](Content& c) { c.residual.basis.shape = 8; });
  expect_refused("per channel", [](Content& c) { c.residual.layers[0].end.pop_back(); });
  expect_refused("ends", [](Content& c) { c.residual.layers[1].end[0] -= 1; });
  expect_refused("ends", [](Content& c) { c.residual.layers[1].end[0] = 3; });
  expect_refused("too large", [](Content& c) { c.residual.layers[1].q[0][0] = residual::max_magnitude + 1; });
  expect_refused("too large",
                 [](Content& c) { c.residual.layers[1].q[0][0] = std::numeric_limits<std::int32_t>::min(); });
}

TEST(Boundaries, AreThePrefixesThatDecode) {
  const auto bytes = pack(test::layered_content());
  const auto ends = boundaries(bytes, limits);
  ASSERT_EQ(ends.size(), 4U);  // the lobes and three refinements
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto prefix = std::span(bytes).first(ends[i]);
    const Unpacked read = unpack(prefix, limits, true);
    EXPECT_EQ(read.refinements_read, static_cast<int>(i));
    EXPECT_EQ(read.refinements_total, 3);
    EXPECT_EQ(read.total_bytes, bytes.size());
    EXPECT_EQ(read.content.errors.size(), 1 + 2 * i);
    EXPECT_EQ(boundaries(prefix, limits), ends);  // the header alone says it
    EXPECT_EQ(refinement_boundaries(prefix, limits), ends);
    test::expect_error(ErrorCode::truncated, {"prefix"}, [&] { unpack(prefix, limits, false); });
  }
  EXPECT_LT(ends.back(), bytes.size());  // the provenance comes last
}

TEST(Boundaries, LastOneIsTheFileWithoutProvenance) {
  Content c = test::layered_content();
  c.provenance.reset();
  const auto bytes = pack(c);
  EXPECT_EQ(boundaries(bytes, limits).back(), bytes.size());
}

TEST(Header, TotalLengthCountsItself) {
  // around 128 the length needs one byte more, which changes the length
  for (std::uint64_t payload = 80; payload < 140; ++payload) {
    const auto header = write_header(Component{}, {{1, payload}});
    std::vector<std::byte> file = header;
    file.resize(header.size() + payload + 4);
    const Header read = read_header(file, limits);
    EXPECT_EQ(read.total_bytes, file.size()) << payload;
    EXPECT_EQ(read.header_bytes, header.size());
  }
}

TEST(Header, ChecksumsAreXxh32Chained) {
  // reference value of XXH32("", 0), then a link
  EXPECT_EQ(chain({}, 0), 0x02CC5D05U);
  const auto bytes = std::as_bytes(std::span("brdf", 4));
  EXPECT_EQ(chain(bytes, 7), XXH32("brdf", 4, 7));
  EXPECT_NE(chain(bytes, 7), chain(bytes, 8));
}

std::uint64_t read_back(const std::vector<std::byte>& bytes) {
  base::ByteReader in(bytes, "test");
  const std::uint64_t v = read_varint(in, "number");
  EXPECT_EQ(in.remaining(), 0U);
  return v;
}

TEST(Varint, RoundTripsInItsShortestForm) {
  for (int shift = 0; shift < 56; ++shift)
    for (const std::uint64_t v : {(std::uint64_t{1} << shift) - 1, std::uint64_t{1} << shift}) {
      std::vector<std::byte> out;
      put_varint(out, v);
      EXPECT_EQ(out.size(), varint_bytes(v));
      EXPECT_EQ(read_back(out), v);
    }
}

TEST(Varint, LongerFormsAreMalformed) {
  const auto bytes = [](std::initializer_list<int> v) {
    std::vector<std::byte> out;
    for (const int b : v) out.push_back(static_cast<std::byte>(b));
    return out;
  };
  for (const auto& wrong :
       {bytes({0x80, 0x00}), bytes({0xFF, 0x80, 0x00}), bytes({0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x01})})
    test::expect_error(ErrorCode::malformed, {"shortest"}, [&] { read_back(wrong); });
  test::expect_error(ErrorCode::truncated, {"number"}, [&] { read_back(bytes({0x80})); });
}

}  // namespace
}  // namespace brdf::container
