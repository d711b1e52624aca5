// SPDX-License-Identifier: Apache-2.0
// The checks of support/sampling_checks.h for real materials and for MERL-layout tables, compressed, at every level.
#include "support/chi_squared.h"
#include "support/data_folders.h"
#include "support/sampling_checks.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>
#include <brdf/ingest.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>

namespace {

using namespace brdf;
namespace fs = std::filesystem;

struct Source {
  std::string name;
  std::function<Measurement()> read;
};

void PrintTo(const Source& s, std::ostream* out) { *out << s.name; }

/// Tables that need no file: a glossy one with bumps, a metal, one that is not mirror-symmetric, one that sends light back.
std::vector<Source> formulas() {
  const auto glossy = [] { return test::bumpy_measurement({90, 45, 60}); };
  const auto metal = [] { return test::lobes_measurement({3, {{LobeKind::ggx, 0.03, 0.9, {0.9, 0.7, 0.4}}}}, {90, 45, 60}); };
  const auto slanted = [] {
    return test::small_measurement({90, 45, 60}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
      const double turn = (wi.x * wo.y - wi.y * wo.x) * (wi.z - wo.z);
      for (std::size_t c = 0; c < f.size(); ++c) f[c] = 0.25 + 0.02 * static_cast<double>(c) + 0.15 * turn;
    });
  };
  const auto retro = [] {
    return test::lobes_measurement({3, {{LobeKind::lambert, 1, 1, {0.2, 0.25, 0.1}}, {LobeKind::retro_ggx, 0.15, 0.5, {0.3, 0.3, 0.3}}}},
                                   {90, 45, 60});
  };
  return {{"glossy", glossy}, {"metal", metal}, {"slanted", slanted}, {"retro", retro}};
}

std::vector<Source> sources() {
  std::vector<Source> all = formulas();
  std::vector<fs::path> files;
  const auto collect = [&files](const fs::path& folder, const char* extension) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == extension) files.push_back(entry.path());
  };
  collect(test::shared_folder() / "data" / "rgl", ".bsdf");
  if (const char* merl = std::getenv("BRDF_MERL_DIR")) collect(merl, ".binary");
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::string name = file.filename().string();
    std::replace_if(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    all.push_back({std::move(name), [file] { return read_measurement(file); }});
  }
  return all;
}

Material compressed(const Source& source) {
  EncodeOptions options;
  options.effort = 0;
  options.target_size = 2048;
  return Material::decode(compress(source.read(), options).bytes);
}

class SampleMaterials : public testing::TestWithParam<Source> {};

TEST_P(SampleMaterials, SlowAllLevelsDrawWhatTheirPdfSays) {
  const Material m = compressed(GetParam());
  const std::vector<Vec3f> views = test::sampling_views();
  const double threshold = test::sidak_threshold(0.01, static_cast<int>(20 * 3 * views.size()));
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact})
    for (const Vec3f& wo : views) {
      SCOPED_TRACE(std::string(to_string(level)) + " at cos " + std::to_string(wo.z));
      test::expect_sampling(m.prepare(level), wo, 30000, threshold);
    }
}

INSTANTIATE_TEST_SUITE_P(All, SampleMaterials, testing::ValuesIn(sources()), [](const auto& test) { return test.param.name; });

// The spread of the weight, on average over all materials, and its largest value over its mean for each.
TEST(SampleMaterials, SlowWeightsAreAlmostConstant) {
  const struct {
    double cosine, deviation;
  } limits[] = {{0.95, 0.05}, {0.6, 0.08}, {0.2, 0.15}};
  const std::vector<Source> all = sources();
  std::map<EvalLevel, std::vector<double>> sums;
  for (const Source& source : all) {
    const Material m = compressed(source);
    for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
      std::vector<double>& sum = sums[level];
      sum.resize(std::size(limits));
      const Material prepared = m.prepare(level);
      for (std::size_t i = 0; i < std::size(limits); ++i) {
        const test::WeightSpread spread = test::weight_spread(prepared, test::direction_at(limits[i].cosine, 1));
        EXPECT_LE(spread.largest, 4) << source.name << ' ' << to_string(level) << " at " << limits[i].cosine;
        sum[i] += spread.deviation;
      }
      EXPECT_LE(test::weight_spread(prepared, test::direction_at(0.02, 1)).largest, 20) << source.name << ' ' << to_string(level);
    }
  }
  for (const auto& [level, sum] : sums)
    for (std::size_t i = 0; i < std::size(limits); ++i)
      EXPECT_LE(sum[i] / static_cast<double>(all.size()), limits[i].deviation) << to_string(level) << " at " << limits[i].cosine;
}

}  // namespace
