// SPDX-License-Identifier: Apache-2.0
// Slots of a scene: colours, proposals, measured tables.
#include "rendered_scene.h"
#include "support/small_measurement.h"
#include "surface/measured_table.h"
#include "surface/rgb_measurement.h"

#include <brdf/encode.h>

#include <numbers>

namespace brdf::render::test {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

Channels spectrum(float from, float to, int count) {
  Channels c{ChannelModel::spectral, count, {}};
  for (int i = 0; i < count; ++i) c.wavelengths_nm.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(count - 1));
  return c;
}

TEST(ChannelsToRgb, WhiteIsWhiteInEveryModel) {
  EXPECT_TRUE(ChannelsToRgb(Channels{}).is_identity());
  const float one = 1;
  EXPECT_EQ(ChannelsToRgb(Channels{ChannelModel::scalar, 1, {}})(std::span<const float>(&one, 1)), Vec3f(1));
  for (const int count : {4, 31, 195}) {
    const std::vector<float> white(static_cast<std::size_t>(count), 1.0f);
    const Vec3f rgb = ChannelsToRgb(spectrum(380, 730, count))(std::span<const float>(white));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1, 1e-5f) << count;
  }
  const std::vector<float> d65{0.95047f, 1, 1.08883f};
  const Vec3f rgb = ChannelsToRgb(Channels{ChannelModel::xyz, 3, {}})(std::span<const float>(d65));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1, 1e-3f);
}

TEST(ChannelsToRgb, HuesAreWhereTheyBelong) {
  const ChannelsToRgb rgb(spectrum(400, 700, 61));
  const auto band = [&rgb](float from, float to) {
    std::vector<float> values(61, 0.0f);
    for (std::size_t i = 0; i < 61; ++i) {
      const float nm = 400 + 5 * static_cast<float>(i);
      if (nm >= from && nm <= to) values[i] = 1;
    }
    return rgb(std::span<const float>(values));
  };
  const Vec3f red = band(600, 700), green = band(520, 560), blue = band(400, 470);
  EXPECT_GT(red.x, 5 * std::max(red.y, red.z));
  EXPECT_GT(green.y, 2 * std::max(green.x, green.z));
  EXPECT_GT(blue.z, 3 * std::max(blue.x, blue.y));
}

TEST(ChannelsToRgb, FitsAreThoseOfTheObserver) {
  // CIE 1931, 2 degrees, at 555 nm: 0.5121, 1.0000, 0.0057; the fits are good to 0.02 or so.
  const Vec3d at555 = colour_matching(555);
  EXPECT_NEAR(at555.x, 0.5121, 0.03);
  EXPECT_NEAR(at555.y, 1.0, 0.02);
  EXPECT_NEAR(at555.z, 0.0057, 0.01);
}

Measurement glossy_table(int channels = 3) {
  return brdf::test::small_measurement({}, channels, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    LobeSet set;
    set.channels = static_cast<int>(f.size());
    set.lobes = {{LobeKind::lambert, 1, 1, std::vector<double>(f.size(), 0.3)}, {LobeKind::ggx, 0.3, 1, std::vector<double>(f.size(), 0.2)}};
    eval_lobes(set, wi, wo, f);
  });
}

/// Integral of the pdf over the hemisphere, and of f cos, by the midpoint rule; against what samples say.
void expect_honest_sampling(const Surface& s, const Vec3f& wo) {
  constexpr int n = 256;
  double whole = 0, albedo = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      const float z = (static_cast<float>(i) + 0.5f) / n, phi = 2 * pi * (static_cast<float>(j) + 0.5f) / (2 * n), r = std::sqrt(1 - z * z);
      const Vec3f wi(r * std::cos(phi), r * std::sin(phi), z);
      const double angle = 2 * std::numbers::pi / (static_cast<double>(n) * 2 * n);
      whole += angle * static_cast<double>(s.pdf(wi, wo));
      albedo += angle * static_cast<double>(s.eval(wi, wo).x * z);
    }
  }
  EXPECT_NEAR(whole, 1, 5e-3);
  Random random(8, 0, 0);
  constexpr int draws = 40000;
  double sum = 0, squares = 0;
  for (int i = 0; i < draws; ++i) {
    const SurfaceSample d = s.sample(wo, random.next3(), TransportMode::radiance);
    ASSERT_GT(d.pdf, 0);
    ASSERT_NEAR(s.pdf(d.wi, wo), d.pdf, 2e-3f * d.pdf + 1e-5f);
    const Vec3f weight = s.eval(d.wi, wo) * (d.wi.z / d.pdf);
    ASSERT_NEAR(weight.x, d.weight.x, 2e-3f * d.weight.x + 1e-5f);
    sum += static_cast<double>(d.weight.x);
    squares += static_cast<double>(d.weight.x * d.weight.x);
  }
  const double mean = sum / draws, error = std::sqrt((squares / draws - mean * mean) / draws);
  EXPECT_NEAR(mean, albedo, 5 * error + 3e-3 * albedo);
}

TEST(Surface, SamplesOfATableAreUnbiased) {
  const auto table = std::make_shared<const MeasuredTable>(glossy_table());
  const Surface s = Surface::from_table(table);
  for (const Vec3f wo : {Vec3f(0, 0, 1), Vec3f(0.6f, 0, 0.8f)}) {
    expect_honest_sampling(s, wo);
    expect_honest_sampling(s.with_proposal(s.proposal().of_lobes()), wo);
    expect_honest_sampling(s.with_proposal(Proposal()), wo);
  }
}

TEST(Surface, ValuesOfATableAreTheInterpolatorsAndHolesAreFilled) {
  Measurement m = glossy_table();
  auto& half = std::get<HalfDifferenceTable>(m.table);
  for (std::size_t i = half.valid.size() / 2; i < half.valid.size(); ++i) half.valid[i] = 0;
  const MeasuredTable table(m);
  const MeasurementInterpolator reference(table.measurement());
  int holes = 0, values = 0;
  Random random(4, 4, 4);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f wi = cosine_direction(random.next(), random.next()), wo = cosine_direction(random.next(), random.next());
    std::array<double, 3> f{};
    const Vec3f shown = table.eval(wi, wo);
    if (reference.eval(Vec3d(wi), Vec3d(wo), f)) {
      ++values;
      EXPECT_EQ(shown, Vec3f(f[0], f[1], f[2]));
    } else if (wi.z > 0.05f && wo.z > 0.05f) {
      ++holes;
      EXPECT_GT(shown.x, 0) << "a hole is not black";
    }
  }
  EXPECT_GT(holes, 20);
  EXPECT_GT(values, 200);
}

TEST(Surface, LightAndViewerCanChangePlaces) {
  const Measurement m = brdf::test::bumpy_measurement({18, 9, 24, true}, 3, 0.8);
  const MeasuredTable plain(m), exchanged(m, true);
  Random random(5, 5, 5);
  int differing = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3f wi = cosine_direction(random.next(), random.next()), wo = cosine_direction(random.next(), random.next());
    EXPECT_EQ(exchanged.eval(wi, wo), plain.eval(wo, wi));
    if (std::abs(exchanged.eval(wi, wo).x / plain.eval(wi, wo).x - 1) > 0.01f) ++differing;
  }
  EXPECT_GT(differing, 50) << "the table is to be other than reciprocal";
  expect_honest_sampling(Surface::from_table(std::make_shared<const MeasuredTable>(m, true)), Vec3f(0.6f, 0, 0.8f));
}

TEST(RgbMeasurement, LooksAsItsSpectrumDoes) {
  const Measurement spectral = glossy_table(8), rgb = rgb_measurement(spectral);
  EXPECT_EQ(rgb.channels.model, ChannelModel::rgb);
  EXPECT_EQ(std::get<HalfDifferenceTable>(rgb.table).values.size() * 8, std::get<HalfDifferenceTable>(spectral.table).values.size() * 3);
  const MeasurementInterpolator before(spectral), after(rgb);
  const ChannelsToRgb colours(spectral.channels);
  std::vector<double> f(8), g(3);
  for (const float x : {0.0f, 0.2f, 0.5f}) {
    const Vec3d wi = glm::normalize(Vec3d(x, 0.1, 1)), wo = glm::normalize(Vec3d(-0.4, x, 0.8));
    ASSERT_TRUE(before.eval(wi, wo, f) && after.eval(wi, wo, g));
    const Vec3f wanted = colours(std::span<const double>(f));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(g[static_cast<std::size_t>(c)], wanted[c], 1e-5 * (1 + std::abs(wanted[c])));
  }
  EXPECT_EQ(rgb_measurement(glossy_table(1)).channels.count, 1);
}

TEST(Surface, SpectraAndScalarsAreShown) {
  const Surface spectral = Surface::from_table(std::make_shared<const MeasuredTable>(glossy_table(8)));
  const Surface grey = Surface::from_table(std::make_shared<const MeasuredTable>(glossy_table(1)));
  const Surface rgb = Surface::from_table(std::make_shared<const MeasuredTable>(glossy_table(3)));
  const Vec3f wi(0.6f, 0, 0.8f), wo(0, 0.6f, 0.8f);
  // the same reflectance in every channel is the same grey
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(spectral.eval(wi, wo)[c], rgb.eval(wi, wo)[c], 2e-3f);
    EXPECT_NEAR(grey.eval(wi, wo)[c], rgb.eval(wi, wo)[c], 1e-5f);
  }
  EncodeOptions options;
  options.effort = 0;
  expect_honest_sampling(Surface::from_material(Material::decode(compress(glossy_table(8), options).bytes)), Vec3f(0.6f, 0, 0.8f));
}

TEST(Surface, ATableInAFurnaceShowsItsAlbedoAndNoMoreThanOne) {
  Scene scene = scene_of(R"({"camera": {"position": [0, 0, 4], "target": [0, 0, 0], "fov": 20}, "film": {"width": 8, "height": 8},
    "environment": {"type": "constant", "radiance": 1}, "materials": {"m": {"type": "lambert", "albedo": 1}}, "shapes": [{"type": "sphere", "material": "m"}]})");
  const std::vector<Surface> surfaces{Surface::from_table(std::make_shared<const MeasuredTable>(glossy_table()))};
  RenderOptions options;
  options.spp = 64;
  const Mean mis = mean_of(render_scene(scene, options, {}, surfaces).film);
  EXPECT_LT(mis.value, 1);
  options.sampling = Sampling::light;
  options.seed = 5;
  const Mean light = mean_of(render_scene(scene, options, {}, surfaces).film);
  EXPECT_LT(mis.error, 0.01 * mis.value);
  EXPECT_NEAR(mis.value, light.value, 5 * std::hypot(mis.error, light.error));
}

TEST(Surface, DeltaLobesKeepTheirDirections) {
  const Surface mirror = Surface::from_analytic(Mirror{{1, 1, 1}}).with_proposal(Proposal());
  const SurfaceSample s = mirror.sample({0.6f, 0, 0.8f}, {0.5f, 0.5f, 0.5f}, TransportMode::radiance);
  EXPECT_NE(s.flags & sample_delta, 0U);
  EXPECT_NEAR(s.wi.x, -0.6f, 1e-6f);
  EXPECT_FALSE(mirror.has_values());
  EXPECT_FALSE(mirror.transmits());
  EXPECT_TRUE(Surface::from_analytic(Dielectric{1.5f}).transmits());
}

}  // namespace
}  // namespace brdf::render::test
