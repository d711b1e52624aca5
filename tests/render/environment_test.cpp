// SPDX-License-Identifier: Apache-2.0
// What environments draw is what their pdf says.
#include "light/environment.h"
#include "light/lat_long.h"
#include "light/lights.h"
#include "light/sky.h"
#include "path/random.h"
#include "support/chi_squared.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace brdf::render {
namespace {

constexpr double pi = std::numbers::pi;

/// A dark picture with a bright spot near a pole and one on the seam.
Image spotted(int width = 48) {
  Image map(width, width / 2);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < width; ++x) map.at(x, y) = Vec3f(0.1f + 0.02f * static_cast<float>((x * 7 + y * 3) % 11));
  map.at(width / 3, 1) = Vec3f(60, 50, 40);
  map.at(0, width / 4) = Vec3f(30);
  map.at(width - 1, width / 4) = Vec3f(30);
  return map;
}

Vec3f radiance(const Environment& e, const Vec3f& d) {
  float ignored;
  return e.radiance(d, e.patch(d), ignored);
}

float pdf_of(const Environment& e, const Vec3f& d) {
  float pdf = -1;
  (void)e.radiance(d, e.patch(d), pdf);
  return pdf;
}

Vec3f draw(const Environment& e, const glm::vec2& u, float& pdf, Vec3f& radiance) { return e.sample(e.draw(e.draw_row(u.y), u.x), pdf, radiance); }

/// Sum over the sphere of value(direction) times solid angle, by the midpoint rule on a fine latitude-longitude grid.
template <class Value>
double integral(int width, Value&& value) {
  double sum = 0;
  for (int y = 0; y < width / 2; ++y) {
    const double low = pi * y / (width / 2), high = pi * (y + 1) / (width / 2);
    const double angle = (std::cos(low) - std::cos(high)) * 2 * pi / width;
    for (int x = 0; x < width; ++x) {
      sum += angle * static_cast<double>(value(direction_at({(static_cast<float>(x) + 0.5f) / static_cast<float>(width), (static_cast<float>(y) + 0.5f) / static_cast<float>(width / 2)})));
    }
  }
  return sum;
}

TEST(EnvironmentMap, DirectionsAndPlacesAreInverse) {
  EXPECT_NEAR(direction_at({0.5f, 0.5f}).z, -1, 1e-6f);
  EXPECT_NEAR(direction_at({0.75f, 0.5f}).x, 1, 1e-6f);
  EXPECT_NEAR(direction_at({0.1f, 0}).y, 1, 1e-6f);
  for (const glm::vec2 uv : {glm::vec2(0.02f, 0.3f), glm::vec2(0.6f, 0.7f), glm::vec2(0.97f, 0.01f)}) {
    const glm::vec2 back = place_of(direction_at(uv));
    EXPECT_NEAR(back.x, uv.x, 1e-5f);
    EXPECT_NEAR(back.y, uv.y, 1e-5f);
  }
}

TEST(EnvironmentMap, PdfIntegratesToOne) {
  for (const float turn : {0.0f, 1.3f}) {
    const Environment e(spotted(), turn);
    EXPECT_NEAR(integral(1536, [&e](const Vec3f& d) { return pdf_of(e, d); }), 1, 2e-3) << turn;
  }
  const Environment constant(Vec3f(3));
  EXPECT_NEAR(integral(256, [&constant](const Vec3f& d) { return pdf_of(constant, d); }), 1, 1e-5);
}

TEST(EnvironmentMap, SamplesFollowThePdf) {
  const Environment e(spotted(), 0);  // so that cells hold whole pixels
  constexpr int columns = 24, rows = 12, draws = 200000, fine = 16;
  std::vector<double> observed(columns * rows, 0), expected(columns * rows, 0);
  const auto cell = [](const Vec3f& d) {
    const glm::vec2 uv = place_of(d);
    return static_cast<std::size_t>(std::min(static_cast<int>(uv.y * rows), rows - 1) * columns + std::min(static_cast<int>(uv.x * columns), columns - 1));
  };
  for (int y = 0; y < rows * fine; ++y) {
    const double angle = (std::cos(pi * y / (rows * fine)) - std::cos(pi * (y + 1) / (rows * fine))) * 2 * pi / (columns * fine);
    for (int x = 0; x < columns * fine; ++x) {
      const Vec3f d = direction_at({(static_cast<float>(x) + 0.5f) / (columns * fine), (static_cast<float>(y) + 0.5f) / (rows * fine)});
      expected[static_cast<std::size_t>((y / fine) * columns + x / fine)] += draws * angle * static_cast<double>(pdf_of(e, d));
    }
  }
  Random random(5, 0, 0);
  for (int i = 0; i < draws; ++i) {
    float pdf = 0;
    Vec3f from_there;
    const Vec3f d = draw(e, random.next2(), pdf, from_there);
    ASSERT_NEAR(glm::length(d), 1, 1e-5f);
    ASSERT_GT(pdf, 0);
    ++observed[cell(d)];
  }
  EXPECT_GT(test::chi_squared_p_value(observed, expected), 1e-4);
}

TEST(EnvironmentMap, SampleAndPdfAgree) {
  const Environment e(spotted(), 2.2f);
  Random random(9, 1, 2);
  int apart = 0;
  for (int i = 0; i < 20000; ++i) {
    float pdf = 0;
    Vec3f from_there;
    const Vec3f d = draw(e, random.next2(), pdf, from_there);
    EXPECT_LT(glm::length(from_there - radiance(e, d)), 1e-3f * glm::length(from_there) + 2e-3f);  // places have five digits, pixels differ by 60
    // a direction on the very edge of a pixel may be told to the next one
    if (std::abs(pdf_of(e, d) - pdf) > 1e-3f * pdf) ++apart;
  }
  EXPECT_LE(apart, 20);
}

TEST(EnvironmentMap, SamplingEstimatesTheIntegralWithLittleVariance) {
  const Environment e(spotted(), 0.7f);
  const double expected = integral(1536, [&e](const Vec3f& d) { return radiance(e, d).x; });
  Random random(3, 0, 0);
  constexpr int draws = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < draws; ++i) {
    float pdf = 0;
    Vec3f from_there;
    const Vec3f d = draw(e, random.next2(), pdf, from_there);
    const double value = static_cast<double>(radiance(e, d).x / pdf);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / draws, deviation = std::sqrt(squares / draws - mean * mean);
  EXPECT_NEAR(mean, expected, 5 * deviation / std::sqrt(draws) + 2e-3 * expected);
  // An even choice of directions deviates by several times the mean: the spots are bright and small.
  EXPECT_LT(deviation, 0.9 * mean);
}

TEST(EnvironmentMap, TurnsAboutTheVertical) {
  Image map(64, 32);
  map.at(32, 16) = map.at(31, 16) = map.at(31, 15) = map.at(32, 15) = Vec3f(1);  // around -z
  const Environment still(map, 0), turned(map, static_cast<float>(pi / 2));
  EXPECT_GT(radiance(still, {0, 0, -1}).x, 0.9f);
  EXPECT_GT(radiance(turned, {1, 0, 0}).x, 0.9f);
  EXPECT_LT(radiance(turned, {0, 0, -1}).x, 0.01f);
}

TEST(EnvironmentMap, BlackOneIsDrawnEvenlyAndGivesNothing) {
  const Environment e(Image(8, 4), 0);
  float pdf = 0;
  Vec3f from_there;
  const Vec3f d = draw(e, {0.3f, 0.6f}, pdf, from_there);
  EXPECT_GT(pdf, 0);
  EXPECT_EQ(radiance(e, d), Vec3f(0));
}

TEST(Sky, LampsShineWhereTheyAre) {
  SkyDescription sky;
  sky.width = 256;
  sky.lamps.push_back({{1, 1, 0}, 20, 20, true, Vec3f(50)});
  const Environment e(make_sky(sky), 0);
  EXPECT_NEAR(radiance(e, glm::normalize(Vec3f(1, 1, 0))).x, 50, 0.1f);
  EXPECT_LT(radiance(e, glm::normalize(Vec3f(-1, 1, 0))).x, 1);
  EXPECT_NEAR(radiance(e, {0, -1, 0}).x, sky.ground.x, 1e-5f);
}

TEST(LightChoice, PdfOfWhatIsSampledIsThatOfWhatIsHit) {
  const AreaLight lamp{Vec3f(2), {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}};  // faces down
  const Lights lights(Environment(spotted(), 0), {lamp}, {DirectionalLight{}}, 3);
  Random random(1, 2, 3);
  int seen[3] = {};
  for (int i = 0; i < 3000; ++i) {
    const float choose = random.next();
    LightDraw draw = lights.draw(choose, random.next2());
    lights.finish(draw);
    const LightSample s = lights.sample(draw, Vec3f(0.2f, 0, 0.1f));
    if (!(s.pdf > 0)) continue;
    float pdf = 0;
    if (s.is_delta) {
      ++seen[0];
    } else if (std::isfinite(s.distance)) {
      ++seen[1];
      EXPECT_EQ(lights.area(0, s.direction.y, s.distance, pdf), Vec3f(2));
      EXPECT_NEAR(pdf, s.pdf, 1e-4f * s.pdf);
    } else {
      ++seen[2];
      (void)lights.background(s.direction, lights.patch(s.direction), pdf);
      EXPECT_NEAR(pdf, s.pdf, 0.5f * s.pdf + 1e-3f);  // next to a pixel's edge the density may be the neighbour's
    }
  }
  for (const int n : seen) EXPECT_GT(n, 100);
}

}  // namespace
}  // namespace brdf::render
