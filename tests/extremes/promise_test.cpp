// SPDX-License-Identifier: Apache-2.0
// Two thousand random tables: each file is as close as it says.
#include "extremes/one_basis_file.h"
#include "support/brdfc_content.h"
#include "support/numeric_bound.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>
#include <brdf/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brdf::test {
namespace {

constexpr std::uint32_t tables = 2000;
const char* const group = "Codec, 2000 random tables";
NumericBound error(group, "log_mae of the decoded file over the recorded one", "ratio", 1);
NumericBound picture(group, "psnr_env recorded above that of the decoded file", "dB", 0);
NumericBound sound(group, "values of the decoded file that are not finite or negative", "count", 0);

double power_of_ten(Lcg& random, double low, double high) { return std::pow(10.0, low + (high - low) * random.unit()); }

struct RandomTable {
  Measurement measurement;
  LobeSet lobes;
};

/// Random lobes, times random noise, with random holes.
RandomTable random_table(std::uint32_t seed) {
  Lcg random(seed * 7919 + 1);
  random.next();
  const int channels = random.below(3) == 0 ? 1 : 3;
  LobeSet lobes{channels, {}};
  const auto color = [&](double low, double high) {
    std::vector<double> c;
    for (int i = 0; i < channels; ++i) c.push_back(power_of_ten(random, low, high));
    return c;
  };
  lobes.lobes.push_back({LobeKind::lambert, 1, 1, color(-4, 0)});
  if (random.below(4) != 0) {
    const LobeKind kind = random.below(4) == 0 ? LobeKind::retro_ggx : LobeKind::ggx;
    const double alpha = power_of_ten(random, -3, 0), f90 = random.unit();
    lobes.lobes.push_back({kind, alpha, f90, color(-3, 0)});
  }
  TableShape shape;
  shape.n_theta_h = static_cast<int>(2 + random.below(9));
  shape.n_theta_d = static_cast<int>(2 + random.below(5));
  shape.n_phi_d = static_cast<int>(2 + random.below(8));
  shape.full_circle = random.below(2) == 0;
  const double scale = power_of_ten(random, -6, 6), noise = random.below(3) == 0 ? 2.0 : 0.2 * random.unit();
  const std::uint32_t holes = random.below(3) == 0 ? 4 : 1000;  // one cell in so many
  Measurement m = small_measurement(shape, channels, [&](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    eval_lobes(lobes, wi, wo, f);
    for (double& v : f) v *= scale * std::exp(noise * (2 * random.unit() - 1));
  });
  auto& t = std::get<HalfDifferenceTable>(m.table);
  for (std::size_t i = 1; i < t.valid.size(); ++i)  // the first cell stays: a table needs one
    if (random.below(holes) == 0) t.valid[i] = 0;
  return {std::move(m), std::move(lobes)};
}

TEST(PromiseSlow, TwoThousandTablesDecodeWithinTheRecordedError) {
  const Vec3f directions[] = {{0, 0, 1}, {0.6F, 0, 0.8F}, {-0.28F, 0.96F * 0.6F, 0.768F}, {0, -0.9999F, 0.0141F}, {1, 0, 1e-6F}};
  double unsound = 0;
  for (std::uint32_t seed = 0; seed < tables; ++seed) {
    const auto [m, lobes] = random_table(seed);
    const auto where = [&] { return "seed " + std::to_string(seed); };
    const encode::Verification verification(m, 0.002, 1);
    const residual::Azimuth azimuth = seed % 2 == 0 ? residual::Azimuth::symmetric : residual::Azimuth::one_way;
    const container::Content content = one_basis_content(m, lobes, verification, azimuth, 30 + static_cast<int>(seed % 60));
    const std::vector<std::byte> bytes = container::pack(content);
    DecodeOptions decode;
    decode.sampling = false;
    const Material material = Material::decode(bytes, decode);
    const int last = material.info().refinements_total;
    for (const RecordedError& recorded : material.info().errors) {
      if (recorded.refinement != last || (last > 0 && recorded.level != EvalLevel::balanced)) continue;
      const ErrorReport report = verification.score(last > 0 ? material : material.prepare(EvalLevel::fast));
      const double largest_recorded = 3.6;
      if (recorded.log_mae < largest_recorded) error.see(report.log_mae.all == 0 ? 0 : report.log_mae.all / recorded.log_mae, where);
      picture.see(std::max(recorded.psnr_env - report.psnr_env, 0.0), where);
    }
    std::vector<float> f(static_cast<std::size_t>(material.channels()));
    for (const Vec3f& wi : directions)
      for (const Vec3f& wo : directions) {
        material.eval(wi, wo, f);
        for (const float v : f) unsound += std::isfinite(v) && v >= 0 ? 0 : 1;
      }
    sound.see(unsound, where);
  }
  for (const NumericBound* b : {&error, &picture, &sound}) {
    EXPECT_GT(b->cases(), tables * 3 / 4);
    b->check();
  }
}

}  // namespace
}  // namespace brdf::test
