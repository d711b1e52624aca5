// SPDX-License-Identifier: Apache-2.0
// Single lobes from mirrors to the roughest surface, across their peaks, on every instruction set, against long double.
#include "support/direction_kinds.h"
#include "extremes/long_double_reference.h"
#include "support/numeric_bound.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numbers>

namespace brdf::test {
namespace {

const char* const group = "Lobes";
const std::pair<double, const char*> alphas[] = {{1e-5, "1e-5"}, {1e-4, "1e-4"}, {1e-3, "1e-3"}, {1e-2, "0.01"},
                                                 {0.1, "0.1"},   {0.3, "0.3"},   {1, "1"}};

std::deque<NumericBound> declare() {
  std::deque<NumericBound> all;
  for (const auto& [alpha, name] : alphas)
    all.emplace_back(group, std::string("alpha ") + name + ", GGX and retro, F0 1 and 0.04: f across the peak", "ulp, backward", 4);
  return all;
}
std::deque<NumericBound> across = declare();

/// Pairs whose half vectors (with wo turned by pi about the normal, for retro lobes) are 0 to 100 alpha from the normal.
DirectionKind around_peak(double alpha, bool retro) {
  DirectionKind k{"", {}, {}};
  for (const double share : {0.0, 0.01, 0.3, 1.0, 3.0, 10.0, 100.0})
    for (const double azimuth : {0.0, 0.9, 2.5})
      for (const double theta : {0.0, 0.3, 0.8, 1.2, 1.5, 1.5689}) {
        const double t = std::atan(share * alpha), half = std::numbers::pi / 2;
        if (t > half - 0.1) continue;
        const Vec3d h(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t));
        const Vec3d o(std::sin(theta), 0, std::cos(theta));
        const double oh = o.x * h.x + o.y * h.y + o.z * h.z;
        const Vec3d i(2 * oh * h.x - o.x, 2 * oh * h.y - o.y, 2 * oh * h.z - o.z);
        if (!(i.z > 1e-7)) continue;
        const double turn = retro ? -1 : 1;
        k.push(Vec3f(i), Vec3f(Vec3d(turn * o.x, turn * o.y, o.z)));
      }
  return k;
}

TEST(Lobes, AcrossTheirPeaks) {
  for (std::size_t a = 0; a < std::size(alphas); ++a)
    for (const bool retro : {false, true})
      for (const double f0 : {1.0, 0.04}) {
        const LobeSet lobes{3, {ggx_lobe(3, alphas[a].first, f0, 1, retro)}};
        const Material m = Material::from_lobes(lobes);
        const DirectionKind k = around_peak(alphas[a].first, retro);
        const std::size_t n = k.wi.size();
        on_every_target([&] {
          std::vector<float> f(3 * n), single(3);
          m.eval(k.wi.span(), k.wo.span(), {f.data(), n});
          for (std::size_t i = 0; i < n; ++i) {
            m.eval(k.wi[i], k.wo[i], single);
            for (const float v : {f[i], single[0]})
              across[a].see(backward_error(lobes, {}, k.wi[i], k.wo[i], 0, v, 8),
                            [&] { return pair_words(k.wi[i], k.wo[i]) + (retro ? ", retro, " : ", ") + simd_target(); });
          }
        });
      }
  for (const NumericBound& b : across) b.check();
}

NumericBound peak(group, "value at the peak, wi = wo = normal, all alphas", "relative", 5e-7);

TEST(Lobes, PeaksAreAsHighAsTheyShould) {
  for (const auto& [alpha, name] : alphas) {
    const Material m = Material::from_lobes({1, {ggx_lobe(1, alpha, 1)}});
    float f[1];
    m.eval({0, 0, 1}, {0, 0, 1}, f);
    const double expected = 1 / (4 * std::numbers::pi * alpha * alpha);
    peak.see(std::fabs(static_cast<double>(f[0]) / expected - 1), [&, n = name] { return std::string("alpha ") + n; });
  }
  peak.check();
}

NumericBound black(group, "F0 0, F90 1: error over the value with F0 1", "relative", 1e-6);

// 1 - cos theta_d is known to some 2^-24, so what Fresnel's term alone gives has few digits where it hardly gives anything.
TEST(Lobes, WithoutReflectanceAtNormalIncidence) {
  for (const auto& [alpha, name] : alphas)
    for (const bool retro : {false, true}) {
      const LobeSet lobes{1, {ggx_lobe(1, alpha, 0, 1, retro)}}, white{1, {ggx_lobe(1, alpha, 1, 1, retro)}};
      const Material m = Material::from_lobes(lobes);
      const DirectionKind k = around_peak(alpha, retro);
      for (std::size_t i = 0; i < k.wi.size(); ++i) {
        float f[1];
        m.eval(k.wi[i], k.wo[i], f);
        const PairNumbers p = pair_numbers(k.wi[i], k.wo[i]);
        const long double error = std::fabs(static_cast<long double>(f[0]) - reference_lobes(lobes, p, 0)) / reference_lobes(white, p, 0);
        black.see(static_cast<double>(error), [&, n = name] { return std::string("alpha ") + n + ", " + pair_words(k.wi[i], k.wo[i]); });
      }
    }
  black.check();
}

NumericBound reference(group, "eval_lobes, the reference in double: error", "relative", 4e-15);

TEST(Lobes, TheDoubleReferenceIsOne) {
  for (const auto& [alpha, name] : alphas)
    for (const bool retro : {false, true}) {
      const LobeSet lobes{1, {ggx_lobe(1, alpha, 0.04, 1, retro), lambert_lobe(1, 0.2)}};
      std::vector<DirectionKind> kinds = direction_kinds();
      kinds.push_back(around_peak(alpha, retro));
      for (const DirectionKind& k : kinds)
        for (std::size_t i = 0; i < k.wi.size(); ++i) {
          double f[1];
          eval_lobes(lobes, Vec3d(k.wi[i]), Vec3d(k.wo[i]), f);
          const long double expected = reference_lobes(lobes, pair_numbers(k.wi[i], k.wo[i]), 0);
          reference.see(static_cast<double>(std::fabs(static_cast<long double>(f[0]) / expected - 1)),
                        [&, n = name] { return std::string("alpha ") + n + ", " + pair_words(k.wi[i], k.wo[i]); });
        }
    }
  reference.check();
}

NumericBound endless(group, "colours up to 1e30 at peaks and at the horizon: values that are not finite", "count", 0);

TEST(Lobes, NoValueOverflows) {
  double count = 0;
  for (const double f0 : {1e30, 1e10})
    for (const int lobes : {1, 8}) {
      LobeSet set{3, {}};
      for (int i = 0; i < lobes; ++i) set.lobes.push_back(ggx_lobe(3, 1e-5, f0, f0, i % 2 == 1));
      residual::ResidualGrid grid = synthetic_grid({2, 2, 2, 3, true});
      std::fill(grid.ratio.begin(), grid.ratio.end(), residual::half_max);
      for (const Material& m : {Material::from_lobes(set), material_of(set, grid)})
        for (const DirectionKind& k : direction_kinds()) {
          const std::size_t n = k.wi.size();
          on_every_target([&] {
            std::vector<float> f(3 * n), single(3);
            m.eval(k.wi.span(), k.wo.span(), {f.data(), n});
            for (std::size_t i = 0; i < n; ++i) {
              m.eval(k.wi[i], k.wo[i], single);
              for (const float v : {f[i], f[n + i], f[2 * n + i], single[0], single[1], single[2]}) {
                count += std::isfinite(v) && v >= 0 ? 0 : 1;
                endless.see(count, [&] { return pair_words(k.wi[i], k.wo[i]) + ", " + simd_target(); });
              }
            }
          });
        }
    }
  endless.check();
}

}  // namespace
}  // namespace brdf::test
