// SPDX-License-Identifier: Apache-2.0
#include "encode/quantiser.h"

#include <Eigen/Cholesky>

namespace brdf::encode {

std::vector<std::vector<double>> solve_coefficients(const ErrorModel& model) {
  // a start that leans towards zero: descent then rarely has to take coefficients back
  constexpr double ridge = 1e-3;
  const auto n = static_cast<Eigen::Index>(model.size);
  Eigen::MatrixXd g = Eigen::Map<const Eigen::MatrixXd>(model.gram.data(), n, n);
  g.diagonal().array() += ridge * g.diagonal().mean() + 1e-300;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(g);
  std::vector<std::vector<double>> a;
  for (const std::vector<double>& b : model.b) {
    const Eigen::VectorXd x = factor.solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
    a.emplace_back(x.data(), x.data() + n);
  }
  return a;
}

}  // namespace brdf::encode
