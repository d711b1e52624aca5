// SPDX-License-Identifier: Apache-2.0
// The quadratic error model against sums over its cells.
#include "encode/bins.h"
#include "encode/dense_kernels.h"
#include "encode/distortion.h"
#include "encode/error_model.h"
#include "encode/quantiser.h"
#include "support/brdfc_content.h"
#include "support/direct_basis.h"
#include "support/small_measurement.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace brdf::encode {
namespace {

using residual::Azimuth;
using residual::BasisCodes;
using residual::ChannelTransform;

const BasisCodes codes{16, 9, 5, 7, 118, 1};

LobeSet simple_lobes(int channels) {
  return {channels, {{LobeKind::lambert, 1, 1, std::vector<double>(static_cast<std::size_t>(channels), 0.3)}}};
}

struct Setting {
  Bins bins;
  std::vector<double> weights;
  std::vector<residual::Frequency> order;
  ChannelTransform transform;
  Azimuth azimuth;
};

Setting setting(Azimuth azimuth, int channels, std::uint32_t count) {
  const Measurement m = test::bumpy_measurement({20, 10, 12, !residual::is_reciprocal(azimuth)}, channels, 0.4);
  Setting s{sample_bins(m, simple_lobes(channels), residual::basis_of(codes), 7, 6, 8),
            {},
            residual::coefficient_order(residual::order_shapes[codes.shape], residual::even_only(azimuth), count),
            channels == 3 ? ChannelTransform::opponent : ChannelTransform::cosine,
            azimuth};
  test::Lcg random(3);
  for (std::size_t i = 0; i < s.bins.cells(); ++i) s.weights.push_back(s.bins.valid[i] != 0 ? random.unit() : 0.0);
  return s;
}

/// Every basis function at a cell, from its definition.
std::vector<double> basis_at(const Setting& s, std::size_t cell) {
  const auto np = static_cast<std::size_t>(s.bins.n_p), nd = static_cast<std::size_t>(s.bins.n_d);
  const std::size_t p = cell % np, d = cell / np % nd, h = cell / np / nd;
  const residual::Basis b = residual::basis_of(codes);
  const double window = s.bins.sin_h[h] / std::hypot(s.bins.sin_h[h], b.window_h) * s.bins.sin_d[d] /
                        std::hypot(s.bins.sin_d[d], b.window_d);
  std::vector<double> v;
  for (const residual::Frequency& f : s.order)
    v.push_back(std::cos(std::numbers::pi * f.k * s.bins.u_h[h]) * std::cos(std::numbers::pi * f.l * s.bins.u_d[d]) *
                test::of_azimuth(f.m, std::acos(s.bins.cos_phi[p]), s.azimuth) *
                std::pow(window, residual::harmonic(f.m, s.azimuth).order));
  return v;
}

double transformed(const Setting& s, std::size_t cell, std::size_t t) {
  const auto n = static_cast<std::size_t>(s.bins.channels);
  const auto matrix = residual::channel_matrix(s.transform, s.bins.channels);
  double y = 0;
  for (std::size_t c = 0; c < n; ++c) y += matrix[t * n + c] * s.bins.y[cell * n + c];
  return y;
}

void expect_model_is_the_sum(const Setting& s) {
  const ErrorModel model = cell_model(s.bins, s.weights, residual::basis_of(codes), s.azimuth, s.order, s.transform);
  const std::size_t n = s.order.size(), channels = static_cast<std::size_t>(s.bins.channels);
  ASSERT_EQ(model.size, n);
  std::vector<double> gram(n * n, 0.0);
  std::vector<std::vector<double>> b(channels, std::vector<double>(n, 0.0));
  double constant = 0;
  for (std::size_t cell = 0; cell < s.bins.cells(); ++cell) {
    const auto v = basis_at(s, cell);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) gram[i * n + j] += s.weights[cell] * v[i] * v[j];
    for (std::size_t t = 0; t < channels; ++t) {
      const double y = transformed(s, cell, t);
      constant += s.weights[cell] * y * y;
      for (std::size_t i = 0; i < n; ++i) b[t][i] += s.weights[cell] * y * v[i];
    }
  }
  const double scale = gram[0];
  for (std::size_t i = 0; i < n * n; ++i) ASSERT_NEAR(model.gram[i], gram[i], 1e-10 * scale) << i / n << ", " << i % n;
  for (std::size_t t = 0; t < channels; ++t)
    for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(model.b[t][i], b[t][i], 1e-10 * scale);
  EXPECT_NEAR(model.constant, constant, 1e-10 * scale);
}

TEST(CellModel, IsTheSumOverTheCells) { expect_model_is_the_sum(setting(Azimuth::one_way, 3, 90)); }
TEST(CellModel, IsTheSumOverTheCellsForEvenHarmonics) { expect_model_is_the_sum(setting(Azimuth::symmetric, 3, 90)); }
TEST(CellModel, IsTheSumOverTheCellsForSines) { expect_model_is_the_sum(setting(Azimuth::reciprocal, 3, 90)); }
TEST(CellModel, IsTheSumOverTheCellsForOtherChannels) { expect_model_is_the_sum(setting(Azimuth::one_way, 5, 40)); }

TEST(CellModel, ErrorIsTheWeightedSquareOfWhatIsMissing) {
  const Setting s = setting(Azimuth::one_way, 3, 60);
  const ErrorModel model = cell_model(s.bins, s.weights, residual::basis_of(codes), s.azimuth, s.order, s.transform);
  test::Lcg random(8);
  std::vector<std::vector<double>> a(3, std::vector<double>(60));
  for (auto& channel : a)
    for (double& v : channel) v = 0.2 * (random.unit() - 0.5);
  double expected = 0;
  for (std::size_t cell = 0; cell < s.bins.cells(); ++cell) {
    const auto v = basis_at(s, cell);
    for (std::size_t t = 0; t < 3; ++t) {
      double missing = transformed(s, cell, t);
      for (std::size_t i = 0; i < v.size(); ++i) missing -= a[t][i] * v[i];
      expected += s.weights[cell] * missing * missing;
    }
  }
  EXPECT_NEAR(model_error(model, a), expected, 1e-9 * expected);
  EXPECT_EQ(model_error(model, {}), model.constant);
}

TEST(SolveCoefficients, IsAMinimum) {
  const Setting s = setting(Azimuth::symmetric, 3, 60);
  const ErrorModel model = cell_model(s.bins, s.weights, residual::basis_of(codes), s.azimuth, s.order, s.transform);
  const auto best = solve_coefficients(model);
  const double error = model_error(model, best);
  EXPECT_GE(error, 0);
  EXPECT_LT(error, 0.2 * model.constant);
  for (const double change : {0.05, -0.05})
    for (std::size_t i : {0U, 1U, 5U, 20U}) {
      auto a = best;
      a[0][i] += change;
      EXPECT_GT(model_error(model, a), error);
    }
}

TEST(Bins, ValuesAreTheLogRatioOfTheMeasurement) {
  // a table that equals the lobes times e^0.5: every valid cell must say 0.5
  LobeSet lobes = simple_lobes(3), brighter = simple_lobes(3);
  for (double& c : brighter.lobes[0].color) c *= std::exp(0.5);
  residual::Basis basis = residual::basis_of(codes);
  basis.epsilon = 0;
  const Bins b = sample_bins(test::lobes_measurement(brighter), lobes, basis, 12, 8, 6);
  std::size_t valid = 0;
  for (std::size_t cell = 0; cell < b.cells(); ++cell) {
    if (b.valid[cell] == 0) continue;
    ++valid;
    for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(b.y[cell * 3 + c], 0.5, 1e-6);
  }
  EXPECT_GT(valid, b.cells() / 3);
  for (std::size_t cell = 0; cell < b.cells(); ++cell)
    EXPECT_TRUE(b.valid[cell] != 0 || std::min(b.cos_i[cell], b.cos_o[cell]) < 0.2)
        << "a cell well above the horizon is empty";
}

TEST(Bins, HalfCircleTablesAreMirroredInPhi) {
  const Bins b = sample_bins(test::bumpy_measurement(), simple_lobes(3), residual::basis_of(codes), 9, 7, 10);
  for (std::size_t row = 0; row < b.cells() / 10; ++row)
    for (std::size_t p = 0; p < 5; ++p) {
      const std::size_t a = row * 10 + p, z = row * 10 + 9 - p;
      ASSERT_EQ(b.valid[a], b.valid[z]);
      if (b.valid[a] == 0) continue;
      ASSERT_NEAR(b.y[a * 3], b.y[z * 3], 0.02);
    }
}

// Cells without a measurement pull the residual to 0, so gently that no measured cell notices.
TEST(CellWeights, AreNotNegativeAndSmallWhereNothingWasMeasured) {
  const Bins b = sample_bins(test::bumpy_measurement(), simple_lobes(3), residual::basis_of(codes), 9, 7, 10);
  const auto w = cell_weights(b, 1.0 / 1024, {});
  ASSERT_EQ(w.size(), b.cells());
  double measured = 0, empty = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    ASSERT_GE(w[i], 0);
    ASSERT_TRUE(std::isfinite(w[i]));
    (b.valid[i] != 0 ? measured : empty) += w[i];
    ASSERT_TRUE(b.valid[i] != 0 || b.y[3 * i] == 0);
  }
  EXPECT_GT(measured, 0);
  EXPECT_LT(empty, 1e-3 * measured);
}

// Whatever the environment adds is a sum of squares: the matrix has no negative eigenvalue and no coefficients give a
// negative error.
TEST(EnvironmentModel, AddsASumOfSquares) {
  const Measurement m = test::bumpy_measurement();
  const LobeSet lobes = simple_lobes(3);
  const residual::Basis basis = residual::basis_of(codes);
  const auto order = residual::coefficient_order(residual::order_shapes[1], true, 50);
  ErrorModel model;
  model.size = order.size();
  model.gram.assign(model.size * model.size, 0.0);
  model.b.assign(3, std::vector<double>(model.size, 0.0));
  const metrics::QuerySet queries = metrics::build_queries(0.02);
  add_environment(model, image_slopes(m, queries), lobes, queries, basis, Azimuth::symmetric, order, ChannelTransform::opponent, 1.0);
  EXPECT_GT(model.constant, 0);
  const auto n = static_cast<Eigen::Index>(model.size);
  const Eigen::MatrixXd g = Eigen::Map<const Eigen::MatrixXd>(model.gram.data(), n, n);
  EXPECT_LT((g - g.transpose()).cwiseAbs().maxCoeff(), 1e-12 * g.cwiseAbs().maxCoeff());
  const auto eigenvalues = g.selfadjointView<Eigen::Lower>().eigenvalues();
  EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff());
  const double best = model_error(model, solve_coefficients(model));
  EXPECT_GE(best, 0);
  EXPECT_LT(best, 0.1 * model.constant);  // the basis explains a smooth residual
}

// Tiles of any width, rows and columns left over included.
TEST(DenseKernels, OuterProductsAreTheirSums) {
  test::Lcg random(5);
  for (const std::size_t n : {1U, 3U, 8U, 13U, 37U}) {
    for (const std::size_t count : {1U, 5U, 130U}) {
      std::vector<double> rows(n * count), gram(n * n), expected;
      for (double& v : rows) v = random.unit() - 0.5;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) gram[i * n + j] = gram[j * n + i] = random.unit();
      expected = gram;
      for (std::size_t p = 0; p < count; ++p)
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = i; j < n; ++j) expected[i * n + j] += 0.7 * rows[p * n + i] * rows[p * n + j];
      add_outer_products(gram.data(), n, rows.data(), count, 0.7);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i; j < n; ++j) {
          ASSERT_EQ(gram[i * n + j], expected[i * n + j]) << "to the last bit: one order of one sum";
          ASSERT_EQ(gram[j * n + i], gram[i * n + j]);
        }
      std::vector<double> sum(n, 1.0);
      add_scaled(sum.data(), rows.data(), -0.3, n);
      for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(sum[i], 1.0 + -0.3 * rows[i]);
    }
  }
}

}  // namespace
}  // namespace brdf::encode
