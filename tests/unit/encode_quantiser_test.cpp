// SPDX-License-Identifier: Apache-2.0
#include "encode/bins.h"
#include "encode/distortion.h"
#include "encode/layers.h"
#include "encode/quantiser.h"
#include "residual/layer_codec.h"
#include "support/small_measurement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brdf::encode {
namespace {

using residual::BasisCodes;

const BasisCodes codes{16, 9, 5, 7, 118, 0, 0};

std::vector<residual::Frequency> order_of(const ErrorModel& model) {
  return residual::coefficient_order(residual::order_shapes[0], true, static_cast<std::uint32_t>(model.size));
}

/// A residual of three channels with exact reciprocity, without layers.
residual::ResidualCode empty_code() {
  residual::ResidualCode code;
  code.basis = codes;
  code.azimuth = residual::Azimuth::symmetric;
  return code;
}

ErrorModel model_of(std::uint32_t count) {
  const Measurement m = test::bumpy_measurement();
  const LobeSet lobes{3, {{LobeKind::lambert, 1, 1, {0.3, 0.25, 0.2}}}};
  const residual::Basis basis = residual::basis_of(codes);
  const Bins bins = sample_bins(m, lobes, basis, 18, 12, 8);
  return cell_model(bins, cell_weights(bins, basis.epsilon, {}), basis, residual::Azimuth::symmetric,
                    residual::coefficient_order(residual::order_shapes[0], true, count),
                    residual::ChannelTransform::opponent);
}

std::vector<std::vector<double>> dequantised(const Quantised& q, double step) {
  std::vector<std::vector<double>> a;
  for (const auto& channel : q.q) {
    a.emplace_back();
    for (const std::int32_t v : channel) a.back().push_back(v * step);
  }
  return a;
}

double bits_of(const Quantised& q) {
  const auto code = make_layers(q, empty_code(), 40, 1);
  if (code.empty()) return 0;
  residual::LayerCodec codec(codes, true, 3, *std::max_element(q.end.begin(), q.end.end()));
  return 8.0 * static_cast<double>(encode_layer(codec, nullptr, code.layers[0]).size());
}

TEST(Quantise, ReportedErrorIsThatOfItsCoefficients) {
  const ErrorModel model = model_of(200);
  const auto start = solve_coefficients(model);
  for (const double step : {1.0, 0.25, 0.06, 0.01})
    for (const int passes : {0, 1, 4}) {
      const Quantised q = quantise(model, start, order_of(model), true, {step, 1.0, passes});
      const double expected = model_error(model, dequantised(q, step));
      EXPECT_NEAR(q.error, expected, 1e-9 * model.constant) << step << " " << passes;
    }
}

TEST(Quantise, EndsAreOnePastTheLastLivingCoefficient) {
  const ErrorModel model = model_of(200);
  const Quantised q = quantise(model, solve_coefficients(model), order_of(model), true, {0.1, 1.0, 3});
  ASSERT_EQ(q.q.size(), 3U);
  EXPECT_GT(q.end[0], 10U);
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_EQ(q.q[c].size(), 200U);
    ASSERT_LE(q.end[c], 200U);
    EXPECT_TRUE(q.end[c] == 0 || q.q[c][q.end[c] - 1] != 0);
    for (std::size_t j = q.end[c]; j < 200; ++j) EXPECT_EQ(q.q[c][j], 0);
  }
}

TEST(Quantise, ADiagonalModelIsAMatrixWithoutNeighbours) {
  ErrorModel matrix = model_of(80);
  ErrorModel diagonal = matrix;
  for (std::size_t i = 0; i < matrix.size; ++i) {
    diagonal.diagonal.push_back(matrix.gram[i * matrix.size + i]);
    for (std::size_t j = 0; j < matrix.size; ++j)
      if (i != j) matrix.gram[i * matrix.size + j] = 0;
  }
  diagonal.gram.clear();
  const auto start = solve_coefficients(matrix);
  const Quantised a = quantise(matrix, start, order_of(matrix), true, {0.05, 1.0, 3});
  const Quantised b = quantise(diagonal, start, order_of(matrix), true, {0.05, 1.0, 3});
  EXPECT_EQ(a.q, b.q);
  EXPECT_DOUBLE_EQ(a.error, b.error);
}

TEST(Quantise, PassesLowerTheCost) {
  const ErrorModel model = model_of(300);
  const auto start = solve_coefficients(model);
  double mean_diagonal = 0;
  for (std::size_t i = 0; i < model.size; ++i)
    mean_diagonal += model.gram[i * model.size + i] / static_cast<double>(model.size);
  for (const double step : {0.5, 0.12, 0.03}) {
    const double lambda = 0.12 * step * step * mean_diagonal;
    const auto cost = [&](int passes) {
      const Quantised q = quantise(model, start, order_of(model), true, {step, 1.0, passes});
      return q.error + lambda * bits_of(q);
    };
    const double rounded = cost(0), once = cost(1), often = cost(5);
    EXPECT_LT(once, rounded) << step;
    EXPECT_LE(often, once * 1.001 + 8 * lambda) << step;  // rates are estimates: a byte may be lost
  }
}

TEST(Quantise, FinerStepsLowerTheErrorAndRaiseTheRate) {
  const ErrorModel model = model_of(200);
  const auto start = solve_coefficients(model);
  double error = model.constant * 1.0001, bits = -1;
  for (const int code : {16, 32, 48, 64, 80}) {
    const Quantised q = quantise(model, start, order_of(model), true, {residual::step_of(code), 1.0, 3});
    EXPECT_LE(q.error, error) << code;
    EXPECT_GE(bits_of(q), bits) << code;
    error = q.error;
    bits = bits_of(q);
  }
  EXPECT_LT(error, 0.05 * model.constant);
}

TEST(Quantise, HigherPriceGivesFewerBits) {
  const ErrorModel model = model_of(200);
  const auto start = solve_coefficients(model);
  const Quantised cheap = quantise(model, start, order_of(model), true, {0.06, 0.3, 3});
  const Quantised dear = quantise(model, start, order_of(model), true, {0.06, 5.0, 3});
  EXPECT_LT(bits_of(dear), bits_of(cheap));
  EXPECT_GT(dear.error, cheap.error);
}

TEST(MakeLayers, SplitsWithoutLoss) {
  const ErrorModel model = model_of(200);
  const Quantised q = quantise(model, solve_coefficients(model), order_of(model), true, {0.05, 1.0, 3});
  for (const int count : {1, 2, 4, 6}) {
    const auto code = make_layers(q, empty_code(), 40, count);
    ASSERT_FALSE(code.empty());
    ASSERT_LE(code.layers.size(), static_cast<std::size_t>(count));
    std::vector<std::vector<std::int32_t>> joined(3);
    for (const residual::Layer& layer : code.layers) {
      EXPECT_FALSE(layer.restart);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(joined[c].size() + layer.q[c].size(), layer.end[c]);
        joined[c].insert(joined[c].end(), layer.q[c].begin(), layer.q[c].end());
      }
    }
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(joined[c], std::vector<std::int32_t>(q.q[c].begin(), q.q[c].begin() + q.end[c]));
  }
}

TEST(MakeLayers, NothingButZerosGivesNone) {
  Quantised q;
  q.q.assign(3, std::vector<std::int32_t>(10, 0));
  q.end.assign(3, 0);
  EXPECT_TRUE(make_layers(q, empty_code(), 40, 4).empty());
}

TEST(LayerCount, GrowsWithTheFile) {
  EXPECT_EQ(layer_count(0), 1);
  for (std::uint64_t n = 1; n < 100000; n *= 2) EXPECT_LE(layer_count(n), layer_count(2 * n));
  EXPECT_LE(layer_count(std::uint64_t{1} << 60), 6);
}

}  // namespace
}  // namespace brdf::encode
