// SPDX-License-Identifier: Apache-2.0
// f where directions are special: float evaluation, one pair and batches, on every instruction set, against long double.
#include "support/direction_kinds.h"
#include "extremes/long_double_reference.h"
#include "extremes/smooth_grid.h"
#include "support/numeric_bound.h"
#include "support/simd_targets.h"
#include "support/small_measurement.h"
#include "support/synthetic_grid.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <deque>

namespace brdf::test {
namespace {

/// Units of 2^-24 that the value itself may be off, before its directions are blamed.
constexpr double roundings = 8;

struct Subject {
  LobeSet lobes;
  residual::ResidualGrid grid;
};

std::vector<Subject> lobe_subjects() {
  return {{usual_lobes(), {}},
          {{3, {ggx_lobe(3, 0.02, 0.5, 1, true), ggx_lobe(3, 0.6, 0.2), lambert_lobe(3, 0.1)}}, {}},
          {{3, {ggx_lobe(3, 1e-3, 0.9)}}, {}}};
}

std::vector<Subject> grid_subjects() {
  std::vector<Subject> all;
  for (const auto azimuth : {residual::Azimuth::one_way, residual::Azimuth::symmetric, residual::Azimuth::reciprocal})
    all.push_back({usual_lobes(), smooth_grid(azimuth)});
  return all;
}

std::string group_of(bool with_grid) { return with_grid ? "Directions, lobes and residual" : "Directions, lobes"; }

/// One bound for each kind of directions.
std::deque<NumericBound> declare(bool with_grid) {
  std::deque<NumericBound> all;
  for (const DirectionKind& kind : direction_kinds()) all.emplace_back(group_of(with_grid), kind.name, "ulp, backward", with_grid ? 16 : 4);
  return all;
}

std::deque<NumericBound> of_lobes = declare(false), of_grids = declare(true);

void compare(const std::vector<Subject>& subjects, std::deque<NumericBound>& bounds) {
  const std::vector<DirectionKind> kinds = direction_kinds();
  for (const Subject& s : subjects) {
    const Material m = material_of(s.lobes, s.grid);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const DirectionKind& kind = kinds[k];
      const std::size_t n = kind.wi.size();
      const auto see = [&](std::size_t i, std::size_t c, float f) {
        bounds[k].see(backward_error(s.lobes, s.grid, kind.wi[i], kind.wo[i], c, f, roundings),
                      [&] { return pair_words(kind.wi[i], kind.wo[i]) + ", " + simd_target(); });
      };
      on_every_target([&] {
        std::vector<float> f(3 * n), single(3);
        m.eval(kind.wi.span(), kind.wo.span(), {f.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
          m.eval(kind.wi[i], kind.wo[i], single);
          for (std::size_t c = 0; c < 3; ++c) {
            see(i, c, single[c]);
            see(i, c, f[c * n + i]);
          }
        }
      });
    }
  }
  for (const NumericBound& b : bounds) b.check();
}

TEST(Directions, LobesHoldTheirBounds) { compare(lobe_subjects(), of_lobes); }

TEST(Directions, LobesAndResidualHoldTheirBounds) { compare(grid_subjects(), of_grids); }

NumericBound longer("Directions, all", "length off by 1e-6 to 1e-3: change of f over that", "ratio", 16);

// f of vectors that are not quite unit is that of the unit ones, up to a small multiple of what is missing.
TEST(Directions, SlightlyNonUnitOnesChangeLittle) {
  const LobeSet lobes{3, {ggx_lobe(3, 0.3, 0.2), ggx_lobe(3, 0.5, 0.1, 1, true), lambert_lobe(3, 0.3)}};
  const Material m = material_of(lobes);
  const DirectionBatch wi = random_directions(2000, 31), wo = random_directions(2000, 32);
  for (const double off : {-1e-3, -1e-4, -1e-6, 1e-6, 1e-4, 1e-3})
    for (std::size_t i = 0; i < wi.size(); ++i) {
      const Vec3f a = wi[i] * static_cast<float>(1 + off), b = wo[i] * static_cast<float>(i % 2 == 0 ? 1 + off : 1);
      float f[3];
      m.eval(a, b, f);
      const auto expected = static_cast<double>(reference_value(lobes, {}, normalised(pair_numbers(a, b)), 0).value);
      longer.see(std::fabs(static_cast<double>(f[0]) / expected - 1) / std::fabs(off), [&] { return pair_words(a, b); });
    }
  longer.check();
}

NumericBound below("Directions, all", "either direction on the horizon or below it: largest f or pdf", "1/sr", 0);

TEST(Directions, OnTheHorizonEverythingIsZero) {
  const DirectionBatch above = random_directions(50, 33);
  const float least = std::numeric_limits<float>::denorm_min();
  for (const Subject& s : {lobe_subjects()[0], grid_subjects()[0], grid_subjects()[1]}) {
    const Material m = material_of(s.lobes, s.grid);
    for (std::size_t i = 0; i < above.size(); ++i)
      for (const float z : {0.0f, -0.0f, -least, -1e-8f, -0.5f}) {
        const float rho = std::sqrt(1 - z * z);
        const Vec3f w{rho * 0.6f, rho * 0.8f, z};
        for (const auto& [wi, wo] : {std::pair{w, above[i]}, std::pair{above[i], w}, std::pair{w, w}}) {
          float f[3];
          const float pdf = m.eval_pdf(wi, wo, f);
          for (const float v : {f[0], f[1], f[2], pdf})
            below.see(std::fabs(static_cast<double>(v)), [&, i = wi, o = wo] { return pair_words(i, o); });
        }
      }
  }
  below.check();
}

NumericBound swapped("Directions, all", "reciprocal materials, wi and wo exchanged: values whose bits change", "count", 0);

/// A measurement that is not reciprocal, compressed to a file that is.
Material enforced(EvalLevel level) {
  EncodeOptions options;
  options.effort = 0;
  options.target_size = 300;
  options.reciprocity = SymmetryMode::enforce;
  DecodeOptions decode;
  decode.level = level;
  const Material m = Material::decode(compress(bumpy_measurement({9, 7, 10, true}, 3, 0.4), options).bytes, decode);
  EXPECT_GT(m.info().refinements_total, 0);
  return m;
}

TEST(Directions, ExchangeChangesNoBitOfAReciprocalMaterial) {
  std::vector<Material> materials = {enforced(EvalLevel::balanced), enforced(EvalLevel::exact)};
  for (const Subject& s : lobe_subjects()) materials.push_back(material_of(s.lobes, s.grid));
  materials.push_back(material_of(usual_lobes(), synthetic_grid({})));
  materials.push_back(material_of(usual_lobes(), synthetic_grid({24, 16, 33, 3, true, false}, 0.5)));
  materials.push_back(material_of(usual_lobes(31), synthetic_grid({8, 6, 7, 31, true})));
  double changed = 0;
  for (const Material& m : materials) {
    ASSERT_TRUE(m.info().reciprocal);
    const auto channels = static_cast<std::size_t>(m.channels());
    for (const DirectionKind& kind : direction_kinds()) {
      const std::size_t n = kind.wi.size();
      on_every_target([&] {
        std::vector<float> there(channels * n), back(channels * n), a(channels), b(channels);
        m.eval(kind.wi.span(), kind.wo.span(), {there.data(), n});
        m.eval(kind.wo.span(), kind.wi.span(), {back.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
          m.eval(kind.wi[i], kind.wo[i], a);
          m.eval(kind.wo[i], kind.wi[i], b);
          for (std::size_t c = 0; c < channels; ++c) {
            changed += std::memcmp(&a[c], &b[c], sizeof(float)) != 0 ? 1 : 0;
            changed += std::memcmp(&there[c * n + i], &back[c * n + i], sizeof(float)) != 0 ? 1 : 0;
            swapped.see(changed, [&] { return pair_words(kind.wi[i], kind.wo[i]) + ", " + simd_target(); });
          }
        }
      });
    }
  }
  swapped.check();
}

}  // namespace
}  // namespace brdf::test
