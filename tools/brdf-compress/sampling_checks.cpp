// SPDX-License-Identifier: Apache-2.0
#include "sampling_checks.h"

#include "chi_squared.h"
#include "counter_random.h"
#include "density_cells.h"
#include "direction_planes.h"
#include "text_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace brdf::cli {
namespace {

struct View {
  double theta, phi;  ///< degrees
};
constexpr std::array views{View{0, 0}, View{30, 40}, View{60, -110}, View{80, 170}};
constexpr std::size_t samples = 100000;
constexpr double false_alarms = 0.01;  ///< of all chi-squared tests together

struct Drawn {
  DirectionPlanes wo{samples}, wi{samples};
  std::vector<float> pdf, weight;
  std::vector<Vec3f> accepted;
};

Vec3f direction(const View& view) {
  const double theta = view.theta * std::numbers::pi / 180, phi = view.phi * std::numbers::pi / 180;
  return Vec3f(Vec3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
}

Drawn draw(const Material& material, const Vec3f& wo, std::uint64_t seed) {
  Drawn d;
  const CounterRandom random(seed);
  DirectionPlanes u(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    d.wo.set(i, wo);
    u.set(i, {random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2)});
  }
  d.pdf.resize(samples);
  d.weight.resize(samples * static_cast<std::size_t>(material.channels()));
  material.sample(d.wo.span(), u.span(), d.wi.span(), d.pdf.data(), {d.weight.data(), samples});
  for (std::size_t i = 0; i < samples; ++i)
    if (d.pdf[i] > 0) d.accepted.push_back(d.wi.get(i));
  return d;
}

/// Largest relative difference that 99 of 100 samples stay below.
double percentile_99(std::vector<double>& differences) {
  if (differences.empty()) return 0;
  const auto at = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
  std::nth_element(differences.begin(), at, differences.end());
  return *at;
}

/// pdf and weight in the samples against what pdf() and eval() say of the same pairs.
Check agreement(const Material& material, const Drawn& d, const std::string& where) {
  const auto channels = static_cast<std::size_t>(material.channels());
  std::vector<float> pdf(samples), f(samples * channels);
  material.eval_pdf(d.wi.span(), d.wo.span(), {f.data(), samples}, pdf.data());
  std::vector<double> differences;
  std::size_t loose = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    double worst = 0;
    if (!(d.pdf[i] > 0)) {
      for (std::size_t c = 0; c < channels; ++c) loose += d.weight[c * samples + i] != 0 ? 1 : 0;
      continue;
    }
    worst = std::abs(static_cast<double>(pdf[i]) / static_cast<double>(d.pdf[i]) - 1);
    for (std::size_t c = 0; c < channels; ++c) {
      const double given = static_cast<double>(d.weight[c * samples + i]);
      const double wanted =
          static_cast<double>(f[c * samples + i]) * static_cast<double>(d.wi.get(i).z) / static_cast<double>(d.pdf[i]);
      worst = std::max(worst, std::abs(given - wanted) / std::max({given, wanted, 1e-6}));
    }
    differences.push_back(std::isfinite(worst) ? worst : 1e30);
  }
  const double value = percentile_99(differences);
  return {"samples agree with pdf and eval", value <= 0.01 && loose == 0, value, "at most 0.01",
          where + (loose == 0 ? "" : ", rejected samples with a weight: " + std::to_string(loose))};
}

Check integral_check(double integral, double rejected, const std::string& where) {
  const double sum = integral + rejected;
  const double noise = std::sqrt(std::max(rejected * (1 - rejected), 1.0 / samples) / samples);
  const bool ok = integral < 1.003 && std::abs(sum - 1) < 0.003 + 4 * noise;
  return {"pdf integrates to 1", ok, sum, "1 within 0.003",
          where + (rejected > 0 ? ", rejected samples " + significant(rejected) : "")};
}

Check distribution_check(const DensityCells& cells, std::size_t rejected, const std::string& where) {
  std::vector<double> observed = cells.count(), expected = cells.mass();
  // The share that is rejected is taken from the samples: it has a check of its own.
  const double accepted = static_cast<double>(samples - rejected);
  for (double& e : expected) e *= accepted / std::max(cells.integral(), 1e-300);
  double stray = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) stray += expected[i] > 0 ? 0 : observed[i];
  const FitTest fine = chi_squared_test(observed, expected, 40);
  const FitTest coarse = chi_squared_test(observed, expected, accepted / 64);
  // Sidak: two tests for each view.
  const double bound = 1 - std::pow(1 - false_alarms, 1.0 / (2.0 * views.size()));
  const double p = std::min(fine.p_value, coarse.p_value);
  return {"samples follow pdf (chi-squared p)", p > bound && stray == 0, p, "above " + significant(bound),
          where + ", " + std::to_string(fine.bins) + " bins" +
              (stray > 0 ? ", samples where pdf is 0: " + significant(stray) : "")};
}

}  // namespace

Checks sampling_checks(const Material& material) {
  Checks checks;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::string where = "theta_o " + fixed(views[k].theta, 0) + " degrees";
    const Vec3f wo = direction(views[k]);
    const Drawn d = draw(material, wo, k + 1);
    const std::size_t rejected = samples - d.accepted.size();
    const DensityCells cells(material, wo, d.accepted);
    checks.push_back(integral_check(cells.integral(), static_cast<double>(rejected) / samples, where));
    checks.push_back(distribution_check(cells, rejected, where));
    checks.push_back(agreement(material, d, where));
  }
  return checks;
}

}  // namespace brdf::cli
