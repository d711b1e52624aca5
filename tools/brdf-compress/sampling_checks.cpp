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
#include <limits>
#include <numbers>
#include <optional>

namespace brdf::cli {
namespace {

struct View {
  double theta, phi;  ///< degrees
};
constexpr std::array views{View{0, 0}, View{30, 40}, View{60, -110}, View{80, 170}, View{89, 20}, View{89.9, -60}};
constexpr std::array spread_cosines{0.95, 0.6, 0.2};
constexpr std::size_t samples = 100000;
constexpr double false_alarms = 0.01;  ///< of all chi-squared tests of three levels together
constexpr double largest_weight = 4;   ///< over the mean
/// Of an integral in cells, and of a mean of 100,000 weights that hardly differ.
constexpr double quadrature_error = 1e-3;

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

/// Directions are floats: near the horizon the azimuth of a half vector at the width of the narrowest lobe is off by this
/// much of cos_o, over which the horizon changes sides. Above 1 floats do not tell such directions from their neighbours.
double azimuth_noise(const Material& material, double cos_o) {
  double alpha = 1;
  for (const Lobe& lobe : material.lobes().lobes)
    if (lobe.kind != LobeKind::lambert) alpha = std::min(alpha, lobe.alpha);
  return 0.5 * std::numeric_limits<float>::epsilon() / (alpha * 2 * cos_o * cos_o);
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
  const double value = percentile_99(differences), allowed = 0.01 + azimuth_noise(material, static_cast<double>(d.wo.get(0).z));
  return {"samples agree with pdf and eval", value <= allowed && loose == 0, value, "at most " + significant(allowed, 2),
          where + (loose == 0 ? "" : ", rejected samples with a weight: " + std::to_string(loose))};
}

Check integral_check(double integral, double rejected, const std::string& where) {
  const double sum = integral + rejected;
  const double noise = std::sqrt(std::max(rejected * (1 - rejected), 1.0 / samples) / samples);
  const bool ok = std::abs(sum - 1) < 0.001 + 4 * noise;
  return {"pdf integrates to 1", ok, sum, "1 within 0.001",
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
  // Sidak: two tests for each view and level.
  const double bound = 1 - std::pow(1 - false_alarms, 1.0 / (2.0 * 3 * views.size()));
  const double p = std::min(fine.p_value, coarse.p_value);
  return {"samples follow pdf (chi-squared p)", p > bound && stray == 0, p, "above " + significant(bound),
          where + ", " + std::to_string(fine.bins) + " bins" +
              (stray > 0 ? ", samples where pdf is 0: " + significant(stray) : "")};
}

/// Mean of the channels of each weight.
struct Weights {
  double mean = 0, deviation = 0, largest = 0;
};

Weights weights_of(const Drawn& d) {
  const std::size_t channels = d.weight.size() / samples;
  Weights w;
  double square = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += static_cast<double>(d.weight[c * samples + i]);
    sum /= static_cast<double>(channels);
    w.mean += sum / samples;
    square += sum * sum / samples;
    w.largest = std::max(w.largest, sum);
  }
  w.deviation = std::sqrt(std::max(square - w.mean * w.mean, 0.0));
  return w;
}

Check mean_check(const Drawn& d, double f_cos, const std::string& where) {
  const Weights w = weights_of(d);
  const double allowed = 4 * w.deviation / std::sqrt(static_cast<double>(samples)) + quadrature_error * f_cos;
  const double off = std::abs(w.mean - f_cos);
  return {"mean weight is the integral of f cos", off <= allowed, f_cos > 0 ? w.mean / f_cos : 1, "1 within 4 standard errors and 0.001",
          where + ", albedo " + significant(f_cos, 4)};
}

/// Samples of a formula are drawn without its Fresnel factor, so the mean says little; what arrives bounds the weight of one
/// bounce, and that of all bounces together nearly so.
double largest_analytic_weight(const AnalyticModel& model) {
  const auto* ggx = std::get_if<GgxReflector>(&model);
  return ggx != nullptr && ggx->multiple_scattering ? 2 : 1.0001;
}

Check largest_check(const Material& material, const std::string& level) {
  const bool formula = material.analytic() != nullptr;
  const double most = formula ? largest_analytic_weight(*material.analytic()) : largest_weight;
  Check check{formula ? "largest weight" : "largest weight over the mean", true, 0, "at most " + significant(most, 5),
              level + ", standard deviations"};
  for (const double cosine : spread_cosines) {
    const Vec3f wo(Vec3d(std::sqrt(1 - cosine * cosine), 0, cosine));
    const Weights w = weights_of(draw(material, wo, 99));
    const double mean = std::max(w.mean, 1e-30);
    check.value = std::max(check.value, formula ? w.largest : w.largest / mean);
    check.note += " " + significant(w.deviation / mean, 2);
  }
  check.note += " at cosines";
  for (const double cosine : spread_cosines) check.note += " " + significant(cosine, 2);
  check.ok = check.value <= most;
  return check;
}

/// The one that failed, or the one furthest from what is wanted.
void keep_worst(std::optional<Check>& worst, Check check, double distance, double& furthest) {
  if (worst && (!worst->ok || (check.ok && distance <= furthest))) return;
  worst = std::move(check);
  furthest = distance;
}

}  // namespace

Checks sampling_checks(const Material& material) {
  const std::string level = std::string("at ") + to_string(material.level());
  std::array<std::optional<Check>, 4> worst;
  std::array<double, 4> furthest{};
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::string where = level + ", theta_o " + significant(views[k].theta, 3) + " degrees";
    const Vec3f wo = direction(views[k]);
    if (azimuth_noise(material, static_cast<double>(wo.z)) > 1) continue;
    const Drawn d = draw(material, wo, k + 1);
    const std::size_t rejected = samples - d.accepted.size();
    const DensityCells cells(material, wo, d.accepted);
    const Check integral = integral_check(cells.integral(), static_cast<double>(rejected) / samples, where);
    const Check follows = distribution_check(cells, rejected, where), agrees = agreement(material, d, where);
    const Check mean = mean_check(d, cells.f_cos(), where);
    keep_worst(worst[0], integral, std::abs(integral.value - 1), furthest[0]);
    keep_worst(worst[1], follows, 1 - follows.value, furthest[1]);
    keep_worst(worst[2], agrees, agrees.value, furthest[2]);
    keep_worst(worst[3], mean, std::abs(mean.value - 1), furthest[3]);
  }
  Checks checks;
  for (std::optional<Check>& check : worst) checks.push_back(std::move(*check));
  checks.push_back(largest_check(material, level));
  return checks;
}

}  // namespace brdf::cli
