// SPDX-License-Identifier: Apache-2.0
#include "residual/layer_codec.h"
#include "residual/reconstruct.h"
#include "support/brdfc_content.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace brdf::residual {
namespace {

using test::residual_of;

std::uint32_t count_of(const ResidualCode& code) {
  std::uint32_t count = 0;
  for (const Layer& layer : code.layers)
    for (const std::uint32_t e : layer.end) count = std::max(count, e);
  return count;
}

std::vector<std::vector<std::byte>> encode_all(const ResidualCode& code) {
  LayerCodec codec(code.basis, even_only(code.azimuth), code.channels, count_of(code));
  std::vector<std::vector<std::byte>> out;
  for (std::size_t i = 0; i < code.layers.size(); ++i)
    out.push_back(encode_layer(codec, i == 0 ? nullptr : &code.layers[i - 1], code.layers[i]));
  return out;
}

void expect_round_trip(const ResidualCode& code) {
  const auto bytes = encode_all(code);
  LayerCodec codec(code.basis, even_only(code.azimuth), code.channels, count_of(code));
  std::vector<Layer> decoded;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    decoded.push_back(decode_layer(codec, i == 0 ? nullptr : &decoded[i - 1], bytes[i],
                                   static_cast<std::size_t>(code.channels), count_of(code)));
    ASSERT_EQ(decoded[i].step, code.layers[i].step);
    ASSERT_EQ(decoded[i].restart, code.layers[i].restart);
    ASSERT_EQ(decoded[i].end, code.layers[i].end);
    ASSERT_EQ(decoded[i].q, code.layers[i].q);
  }
}

TEST(Layers, OneLayer) { expect_round_trip(residual_of(3, true, {{64, false, {100, 50, 20}}})); }

TEST(Layers, LayersThatGoOn) {
  expect_round_trip(
      residual_of(3, false, {{64, false, {10, 5, 0}}, {64, false, {80, 5, 30}}, {70, false, {200, 90, 31}}}));
}

TEST(Layers, LayersThatBeginAgain) {
  expect_round_trip(
      residual_of(2, true, {{20, false, {30, 10}}, {40, true, {60, 20}}, {40, false, {90, 20}}, {60, true, {10, 90}}}));
}

TEST(Layers, EmptyLayerAndEmptyChannels) {
  expect_round_trip(residual_of(3, true, {{0, false, {0, 0, 0}}}));
  expect_round_trip(residual_of(3, true, {{255, false, {0, 7, 0}}, {255, false, {0, 7, 0}}}));
}

TEST(Layers, ManyChannels) {
  expect_round_trip(residual_of(33, false, {{64, false, std::vector<std::uint32_t>(33, 40)}}));
}

TEST(Layers, LargestCount) { expect_round_trip(residual_of(1, true, {{64, false, {max_coefficients}}})); }

TEST(Layers, LargestMagnitudes) {
  ResidualCode code = residual_of(1, false, {{64, false, {12}}});
  code.layers[0].q[0] = {max_magnitude, -max_magnitude, 0, 14, 15, 16, -15, -16, 1, -1, 17, max_magnitude};
  expect_round_trip(code);
}

// Every symbol on the path of 15 leaves the lower end of the coder's interval where it is: the bytes end in zeros.
TEST(Layers, RunsOfTheEscapeValueDecode) {
  for (std::uint32_t n = 1; n <= 60; ++n) {
    ResidualCode code = residual_of(1, false, {{64, false, {n}}});
    code.layers[0].q[0].assign(n, 15);
    ASSERT_NO_THROW(expect_round_trip(code)) << n;
  }
}

TEST(Layers, ThousandsOfSmallLayersDecode) {
  for (std::uint32_t seed = 1; seed <= 4000; ++seed)
    ASSERT_NO_THROW(expect_round_trip(residual_of(1, true, {{64, false, {1 + seed % 20}}}, seed))) << seed;
}

TEST(Layers, ContextsLearnFromEarlierLayers) {
  // the second half of a residual is smaller when the first half is known than on its own
  const ResidualCode both = residual_of(1, true, {{64, false, {150}}, {64, false, {300}}}, 4);
  const ResidualCode whole = residual_of(1, true, {{64, false, {300}}}, 4);
  std::size_t sum = 0;
  for (const auto& bytes : encode_all(both)) sum += bytes.size();
  EXPECT_LE(sum, encode_all(whole)[0].size() + 6);  // only the second head
}

TEST(Layers, ZerosCostNearlyNothing) {
  ResidualCode code = residual_of(1, false, {{64, false, {4000}}});
  std::fill(code.layers[0].q[0].begin(), code.layers[0].q[0].end(), 0);
  EXPECT_LT(encode_all(code)[0].size(), 40U);
}

TEST(Layers, EndBeyondTheDeclaredCountIsMalformed) {
  const ResidualCode code = residual_of(1, false, {{64, false, {50}}});
  const auto bytes = encode_all(code);
  LayerCodec codec(code.basis, false, 1, 49);
  test::expect_error(ErrorCode::malformed, {"channel 0", "50", "49"},
                     [&] { decode_layer(codec, nullptr, bytes[0], 1, 49); });
}

TEST(Layers, LayersThatAddUpToMoreThanTheCountAreMalformed) {
  const ResidualCode code = residual_of(1, false, {{64, false, {30}}, {64, false, {60}}});
  const auto bytes = encode_all(code);
  LayerCodec codec(code.basis, false, 1, 59);
  const Layer first = decode_layer(codec, nullptr, bytes[0], 1, 59);
  test::expect_error(ErrorCode::malformed, {"60", "59"}, [&] { decode_layer(codec, &first, bytes[1], 1, 59); });
}

TEST(Layers, MissingBytesAreMalformed) {
  const ResidualCode code = residual_of(3, false, {{64, false, {200, 200, 200}}});
  auto bytes = encode_all(code)[0];
  bytes.resize(bytes.size() - 5);
  LayerCodec codec(code.basis, false, 3, 200);
  test::expect_error(ErrorCode::malformed, {"beyond its end"}, [&] { decode_layer(codec, nullptr, bytes, 3, 200); });
}

TEST(Dequantise, AddsLayersUpAndStopsWhereAsked) {
  ResidualCode code;
  code.channels = 2;
  code.layers.push_back({32, false, {3, 1}, {{4, 0, -2}, {1}}});    // step 2^(4 - 4) = 1
  code.layers.push_back({40, false, {4, 1}, {{6}, {}}});            // 1/2
  code.layers.push_back({48, true, {2, 3}, {{1, -1}, {0, 0, 8}}});  // 1/4, from the beginning
  const Coefficients all = dequantise(code, ChannelTransform::identity, 3);
  EXPECT_EQ(all.order.size(), 4U);
  EXPECT_EQ(all.values[0], (std::vector<float>{4.25F, -0.25F, -2, 3}));
  EXPECT_EQ(all.values[1], (std::vector<float>{1, 0, 2, 0}));
  const Coefficients two = dequantise(code, ChannelTransform::identity, 2);
  EXPECT_EQ(two.values[0], (std::vector<float>{4, 0, -2, 3}));
  EXPECT_EQ(two.values[1], (std::vector<float>{1, 0, 0, 0}));
  EXPECT_TRUE(dequantise(code, ChannelTransform::identity, 0).order.empty());
  EXPECT_EQ(dequantise(code, ChannelTransform::identity, 99).values, all.values);
}

}  // namespace
}  // namespace brdf::residual
