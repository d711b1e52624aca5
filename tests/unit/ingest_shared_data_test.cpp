// SPDX-License-Identifier: Apache-2.0
// Real measured materials, where they are at hand: values against an evaluator written independently in another
// language from the format's description.
#include "support/data_folders.h"

#include <brdf/ingest.h>

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

namespace brdf {
namespace {

std::filesystem::path rgl_folder() { return test::shared_folder() / "data" / "rgl"; }

struct Row {
  Vec3d wi, wo;
  std::array<double, 3> f;
};

void expect_rows(const char* file, std::initializer_list<Row> rows) {
  const auto path = rgl_folder() / file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const Measurement m = read_measurement(path);
  const MeasurementInterpolator interpolator(m);
  for (const Row& row : rows) {
    std::array<double, 3> f{};
    EXPECT_TRUE(interpolator.eval(row.wi, row.wo, f));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(f[c], row.f[c], 1e-9 * row.f[c]) << file;
  }
}

TEST(IngestSharedData, AVinylFilm) {
  expect_rows("cc_ibiza_sunset_rgb.bsdf", {{{0.16317591116653482, 0.0593911746138847, 0.984807753012208},
                                            {-0.4393850417707049, 0.36868782649461246, 0.8191520442889918},
                                            {0.07440506051897375, 0.03339786335635862, 0.0362825909308566}},
                                           {{0.7071067811865475, 0.0, 0.7071067811865476},
                                            {-0.694552570624523, -0.012123460216311565, 0.7193398003386512},
                                            {3.377720883624509, 1.7032044579259167, 1.2639504606801244}},
                                           {{0.46984631039295427, -0.8137976813493736, 0.3420201433256688},
                                            {0.2868422278517139, 0.18627752081659346, 0.9396926207859084},
                                            {0.00620795815011253, 0.0025325369533773876, 0.0006435755942671137}},
                                           {{-0.17101007166283433, 0.9698463103929541, 0.17364817766693041},
                                            {0.2531632279912453, -0.9448180294714709, 0.20791169081775945},
                                            {8.827009927531906, 8.844184472220192, 8.654278413787255}}});
}

TEST(IngestSharedData, ACarPaint) {
  expect_rows("irid_flake_paint1_rgb.bsdf", {{{0.16317591116653482, 0.0593911746138847, 0.984807753012208},
                                              {-0.4393850417707049, 0.36868782649461246, 0.8191520442889918},
                                              {0.004151132784378016, 0.00650770028338757, 0.014391130679368926}},
                                             {{0.7071067811865475, 0.0, 0.7071067811865476},
                                              {-0.694552570624523, -0.012123460216311565, 0.7193398003386512},
                                              {11.945516314609362, 12.013246261494004, 12.347649025127108}},
                                             {{0.46984631039295427, -0.8137976813493736, 0.3420201433256688},
                                              {0.2868422278517139, 0.18627752081659346, 0.9396926207859084},
                                              {0.018135630701029273, 0.007480088404663538, 0.0029553312902181853}},
                                             {{-0.17101007166283433, 0.9698463103929541, 0.17364817766693041},
                                              {0.2531632279912453, -0.9448180294714709, 0.20791169081775945},
                                              {0.20970716065138412, 0.19911255205394252, 0.16866340450416714}}});
}

TEST(IngestSharedData, ALargerTable) {
  expect_rows("cg_sunflower_rgb.bsdf", {{{0.16317591116653482, 0.0593911746138847, 0.984807753012208},
                                         {-0.4393850417707049, 0.36868782649461246, 0.8191520442889918},
                                         {0.26780223268938014, 0.12535112744898755, 0.0}},
                                        {{0.7071067811865475, 0.0, 0.7071067811865476},
                                         {-0.694552570624523, -0.012123460216311565, 0.7193398003386512},
                                         {1.5231846855973037, 1.2228620292534809, 0.9388500162215713}},
                                        {{0.46984631039295427, -0.8137976813493736, 0.3420201433256688},
                                         {0.2868422278517139, 0.18627752081659346, 0.9396926207859084},
                                         {0.2380514853502713, 0.11137799951104833, 0.0}},
                                        {{-0.17101007166283433, 0.9698463103929541, 0.17364817766693041},
                                         {0.2531632279912453, -0.9448180294714709, 0.20791169081775945},
                                         {0.2343660259753621, 0.1583286183258118, 0.07311658661587175}}});
}

TEST(IngestSharedData, EveryRglFileReadsAndReportsSoundFigures) {
  if (!std::filesystem::exists(rgl_folder())) GTEST_SKIP() << rgl_folder() << " is absent";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(rgl_folder())) {
    const IngestReport r = report(read_measurement(entry.path()));
    ++files;
    EXPECT_LT(r.mirror_asymmetry, 1e-6) << entry.path();
    EXPECT_GT(r.reciprocity_asymmetry, 1e-3) << entry.path();
    EXPECT_LT(r.negative_fraction, 0.27) << entry.path();
    EXPECT_GT(r.max_albedo, 0.05) << entry.path();
    EXPECT_LT(r.max_albedo, 1.1) << entry.path();
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace brdf
