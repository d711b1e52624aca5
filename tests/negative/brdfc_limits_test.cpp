// SPDX-License-Identifier: Apache-2.0
// Counts that would cost memory are refused before any is taken.
#include "container/bit_stream.h"
#include "container/content.h"
#include "container/residual_chunk.h"
#include "residual/range_coder.h"
#include "residual/value_codes.h"
#include "support/brdfc_content.h"
#include "support/brdfc_parts.h"
#include "support/expect_error.h"

#include <brdf/material.h>

#include <gtest/gtest.h>

namespace brdf::container {
namespace {

using test::expect_error;
using test::FileParts;

FileParts layered() { return test::parts_of(pack(test::layered_content())); }

void read(const FileParts& parts, const DecodeLimits& limits = {}) { unpack(parts.build(), limits, false); }

TEST(BrdfcLimits, FileBytes) {
  DecodeLimits limits;
  const auto size = layered().build().size();
  limits.max_file_bytes = size;
  EXPECT_NO_THROW(read(layered(), limits));
  limits.max_file_bytes = size - 1;
  expect_error(ErrorCode::limit_exceeded, {std::to_string(size).c_str()}, [&] { read(layered(), limits); });
}

TEST(BrdfcLimits, DeclaredTotalAndChunkLength) {
  FileParts p = layered();
  p.stated_total = std::uint64_t{1} << 50;
  expect_error(ErrorCode::limit_exceeded, {"1125899906842624"}, [&] { read(p); });
  p = layered();
  p.chunks[1].stated_length = std::uint64_t{1} << 50;
  expect_error(ErrorCode::limit_exceeded, {"chunk 1", "1125899906842624"}, [&] { read(p); });
  p.chunks[1].stated_length = std::uint64_t{1} << 20;
  expect_error(ErrorCode::malformed, {"add up"}, [&] { read(p); });
}

TEST(BrdfcLimits, ChunkCount) {
  for (const std::uint64_t n : {69U, 100000U}) {
    FileParts p = layered();
    p.stated_chunks = n;
    expect_error(ErrorCode::limit_exceeded, {std::to_string(n).c_str(), "68"}, [&] { read(p); });
  }
  FileParts p = layered();
  p.stated_chunks = (std::uint64_t{1} << 56) - 1;
  expect_error(ErrorCode::limit_exceeded, {"chunks"}, [&] { read(p); });
  DecodeLimits limits;
  limits.max_refinements = 0;
  expect_error(ErrorCode::limit_exceeded, {"5 chunks", "4"}, [&] { read(layered(), limits); });
}

TEST(BrdfcLimits, Channels) {
  FileParts p = layered();
  p.component[1] = std::byte{2};  // spectral
  p.component.resize(2);
  put_varint(p.component, std::uint64_t{1} << 40);
  expect_error(ErrorCode::limit_exceeded, {"1099511627776", "1024"}, [&] { read(p); });
  DecodeLimits limits;
  limits.max_channels = 4;
  expect_error(ErrorCode::limit_exceeded, {"5 channels", "4"},
               [&] { read(test::parts_of(pack(test::spectral_content())), limits); });
}

TEST(BrdfcLimits, Lobes) {
  DecodeLimits limits;
  limits.max_lobes = 2;
  expect_error(ErrorCode::limit_exceeded, {"3", "2"}, [&] { read(layered(), limits); });
}

/// A residual chunk whose basis declares `count` coefficients and whose first layer says that each of `channels` channels
/// has `length` of them.
std::vector<std::byte> residual_payload(std::uint32_t count, std::size_t channels, std::uint32_t length) {
  std::vector<std::byte> out(4);
  BitWriter bits;
  write_basis(bits, {}, count);
  out.insert(out.end(), bits.bytes().begin(), bits.bytes().end());
  residual::RangeEncoder coder;
  coder.raw(8, 64);
  coder.raw(1, 0);
  for (std::size_t c = 0; c < channels; ++c) residual::code_count(coder, length);
  const auto layer = coder.finish();
  out.insert(out.end(), layer.begin(), layer.end());
  return out;
}

TEST(BrdfcLimits, CoefficientsBeyondTheFormat) {
  for (const std::uint32_t count : {16385U, 32767U}) {
    FileParts p = layered();
    p.chunks.resize(2);
    p.chunks[1].payload = residual_payload(count, 3, 1);
    expect_error(ErrorCode::malformed, {std::to_string(count).c_str(), "16384"}, [&] { read(p); });
  }
}

TEST(BrdfcLimits, CoefficientsBeyondTheDeclaredCount) {
  FileParts p = layered();
  p.chunks.resize(2);
  p.chunks[1].payload = residual_payload(100, 3, 101);
  expect_error(ErrorCode::malformed, {"101", "100"}, [&] { read(p); });
}

// A thousand channels of sixteen thousand coefficients are 64 MB in a file of two thousand bytes.
TEST(BrdfcLimits, CoefficientsOfManyChannels) {
  Content c;
  c.component.channels = {ChannelModel::spectral, 1000, {}};
  for (int i = 0; i < 1000; ++i) c.component.channels.wavelengths_nm.push_back(static_cast<float>(300 + i));
  c.component.transform = residual::ChannelTransform::cosine;
  c.lobes.channels = 1000;
  FileParts p = test::parts_of(pack(c));
  p.chunks.push_back({2, residual_payload(residual::max_coefficients, 1000, residual::max_coefficients), std::nullopt});
  DecodeLimits limits;
  limits.max_temporary_bytes = 1 << 24;
  expect_error(ErrorCode::limit_exceeded, {"coefficients"}, [&] { read(p, limits); });
}

// Every layer may begin again, so that the sum over the layers counts.
TEST(BrdfcLimits, CoefficientsOfAllLayers) {
  const std::uint64_t needed = unpack(layered().build(), {}, false).temporary_bytes;
  EXPECT_GE(needed, 4U * 60 * 3 * (1 + 3));  // bytes * count * channels * (their sum and three layers)
  DecodeLimits limits;
  limits.max_temporary_bytes = needed;
  EXPECT_NO_THROW(read(layered(), limits));
  limits.max_temporary_bytes = needed - 1;
  expect_error(ErrorCode::limit_exceeded, {"coefficients", std::to_string(needed).c_str()}, [&] { read(layered(), limits); });
  FileParts fewer = layered();
  fewer.chunks.erase(fewer.chunks.begin() + 3);
  EXPECT_GE(needed, unpack(fewer.build(), {}, false).temporary_bytes + 4U * 60 * 3);
}

TEST(BrdfcLimits, TablesOfALevel) {
  const auto bytes = pack(test::layered_content());
  DecodeOptions options;
  options.limits.max_table_bytes = 200000;  // balanced needs 56 * 28 * 13 * 3 halves and padding: 122320 bytes
  const Material m = Material::decode(bytes, options);
  expect_error(ErrorCode::limit_exceeded, {"exact", "200000"}, [&] { m.prepare(EvalLevel::exact); });
  options.limits.max_table_bytes = 122319;
  expect_error(ErrorCode::limit_exceeded, {"balanced", "122320"}, [&] { Material::decode(bytes, options); });
  options.level = EvalLevel::fast;
  EXPECT_NO_THROW(Material::decode(bytes, options));
}

}  // namespace
}  // namespace brdf::container
