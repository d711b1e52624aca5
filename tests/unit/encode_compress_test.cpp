// SPDX-License-Identifier: Apache-2.0
// compress() as a whole, on tables small enough for a unit test.
#include "support/direction_batch.h"
#include "support/expect_error.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace brdf {
namespace {

using test::bumpy_measurement;
using test::expect_error;

EncodeOptions quick() {
  EncodeOptions o;
  o.effort = 0;
  return o;
}

EncodeOptions quick_size(std::uint64_t bytes) {
  EncodeOptions o = quick();
  o.target_size = bytes;
  return o;
}

Material decoded(const EncodeResult& r, EvalLevel level = EvalLevel::balanced) {
  DecodeOptions o;
  o.level = level;
  return Material::decode(r.bytes, o);
}

/// Mean |log(1 + f) - log(1 + f')| over pairs that have a measurement.
double mean_error(const Measurement& m, const Material& material) {
  const MeasurementInterpolator reference(m);
  const auto wi = test::random_directions(3000, 1), wo = test::random_directions(3000, 2);
  const auto n = static_cast<std::size_t>(m.channels.count);
  std::vector<double> f(n);
  std::vector<float> g(n);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < wi.size(); ++i) {
    if (wi[i].z < 0.15F || wo[i].z < 0.15F || !reference.eval(Vec3d(wi[i]), Vec3d(wo[i]), f)) continue;
    material.eval(wi[i], wo[i], g);
    for (std::size_t c = 0; c < n; ++c) sum += std::abs(std::log1p(f[c]) - std::log1p(static_cast<double>(g[c])));
    count += n;
  }
  return sum / static_cast<double>(count);
}

TEST(Compress, SizesAreNeverExceededAndMoreBytesHelp) {
  const Measurement m = bumpy_measurement();
  double first = 0, last = 0;
  for (const std::uint64_t size : {48U, 64U, 100U, 128U, 200U, 300U, 512U, 1000U, 2048U, 4096U}) {
    const EncodeResult r = compress(m, quick_size(size));
    EXPECT_LE(r.bytes.size(), size);
    EXPECT_EQ(r.summary.bytes, r.bytes.size());
    last = mean_error(m, decoded(r));
    if (first == 0) first = last;
  }
  EXPECT_LT(last, 0.25 * first);
}

TEST(Compress, SizesHoldWithProvenanceToo) {
  const Measurement m = bumpy_measurement();
  for (const std::uint64_t size : {160U, 400U, 1024U}) {
    EncodeOptions o = quick_size(size);
    o.store_provenance = true;
    const EncodeResult r = compress(m, o);
    EXPECT_LE(r.bytes.size(), size);
    EXPECT_EQ(decoded(r).info().provenance.name, "formula");
  }
}

TEST(Compress, SizesThatHoldNothingAreRefused) {
  for (const std::uint64_t size : {0U, 1U, 16U})
    expect_error(ErrorCode::target_not_met, {"smallest file"},
                 [&] { compress(bumpy_measurement(), quick_size(size)); });
}

TEST(Compress, BytesDoNotDependOnThreads) {
  const Measurement m = bumpy_measurement();
  EncodeOptions o = quick_size(700);
  const EncodeResult one = compress(m, o);
  o.threads = 2;
  EXPECT_EQ(compress(m, o).bytes, one.bytes);
  o.threads = 1;
  EXPECT_EQ(compress(m, o).bytes, one.bytes);
}

TEST(Compress, ALambertianTableIsOneLobe) {
  const Measurement m = test::lobes_measurement({3, {{LobeKind::lambert, 1, 1, {0.5, 0.4, 0.3}}}});
  const EncodeResult r = compress(m, quick());
  const Material material = decoded(r);
  ASSERT_EQ(material.lobes().lobes.size(), 1U);
  EXPECT_EQ(material.lobes().lobes[0].kind, LobeKind::lambert);
  EXPECT_LT(r.bytes.size(), 60U) << "a residual of rounding errors is worth no bytes";
  EXPECT_LT(mean_error(m, material), 5e-4);
}

TEST(Compress, EnforcedReciprocityIsExact) {
  const Measurement m = bumpy_measurement({36, 18, 48, true}, 3, 0.5);
  EncodeOptions o = quick_size(600);
  o.reciprocity = SymmetryMode::enforce;
  const EncodeResult r = compress(m, o);
  EXPECT_TRUE(r.summary.reciprocal);
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    const Material material = decoded(r, level);
    EXPECT_TRUE(material.info().reciprocal);
    const auto wi = test::random_directions(2000, 3), wo = test::random_directions(2000, 4);
    for (std::size_t i = 0; i < wi.size(); ++i) {
      float a[3], b[3];
      material.eval(wi[i], wo[i], a);
      material.eval(wo[i], wi[i], b);
      ASSERT_EQ(std::memcmp(a, b, sizeof a), 0) << i;
    }
  }
}

TEST(Compress, TablesOfTheFullCircleKeepTheirDirection) {
  const Measurement m = bumpy_measurement({36, 18, 48, true}, 3, 0.5);
  const EncodeResult kept = compress(m, quick_size(900));
  EXPECT_FALSE(kept.summary.reciprocal);
  EncodeOptions o = quick_size(900);
  o.reciprocity = SymmetryMode::enforce;
  EXPECT_LT(mean_error(m, decoded(kept)), 0.7 * mean_error(m, decoded(compress(m, o))));
}

TEST(Compress, ErrorTargetsAreMet) {
  const Measurement m = bumpy_measurement();
  for (const ErrorTarget target :
       {ErrorTarget{Metric::log_mae, 0.02}, ErrorTarget{Metric::log_mae, 0.006}, ErrorTarget{Metric::psnr_env, 32}}) {
    EncodeOptions o = quick();
    o.target_error = target;
    const EncodeResult r = compress(m, o);
    const RecordedError* found = nullptr;
    for (const RecordedError& e : r.summary.errors)
      if (e.refinement == r.summary.refinements && (e.level == o.level || r.summary.refinements == 0)) found = &e;
    ASSERT_NE(found, nullptr);
    if (target.metric == Metric::log_mae) {
      EXPECT_LE(found->log_mae, target.value);
    } else {
      EXPECT_GE(found->psnr_env, target.value);
    }
  }
}

TEST(Compress, FinerErrorTargetsCostMoreBytes) {
  const Measurement m = bumpy_measurement();
  std::size_t before = 0;
  for (const double value : {0.05, 0.015, 0.006}) {
    EncodeOptions o = quick();
    o.target_error = ErrorTarget{Metric::log_mae, value};
    const std::size_t size = compress(m, o).bytes.size();
    EXPECT_GE(size, before) << value;
    before = size;
  }
}

TEST(Compress, ErrorTargetsOutOfReachSayWhatIsInReachSlow) {
  EncodeOptions o = quick();
  o.target_error = ErrorTarget{Metric::log_mae, 1e-9};
  expect_error(ErrorCode::target_not_met, {"log_mae", "best reachable"}, [&] { compress(bumpy_measurement(), o); });
}

TEST(Compress, RecordedErrorsFallWithTheRefinements) {
  const Measurement m = bumpy_measurement();
  const EncodeResult r = compress(m, quick_size(3000));
  ASSERT_GE(r.summary.refinements, 2);
  const auto errors = decoded(r).info().errors;
  ASSERT_EQ(errors.size(), 1U + 2U * static_cast<std::size_t>(r.summary.refinements));
  EXPECT_LT(errors.back().log_mae, 0.5 * errors.front().log_mae);
  EXPECT_GT(errors.back().psnr_env, errors.front().psnr_env);
}

TEST(Compress, OtherChannelCounts) {
  for (const int channels : {1, 5}) {
    const Measurement m = bumpy_measurement({}, channels);
    const EncodeResult r = compress(m, quick_size(800));
    EXPECT_LE(r.bytes.size(), 800U);
    const Material material = decoded(r);
    EXPECT_EQ(material.channels(), channels);
    EXPECT_EQ(material.info().channels.wavelengths_nm, m.channels.wavelengths_nm);
    EXPECT_LT(mean_error(m, material), 0.03);
  }
}

TEST(Compress, TheSmallestTableThatInterpolates) {
  const Measurement m = bumpy_measurement({2, 2, 2});
  EXPECT_NO_THROW(decoded(compress(m, quick_size(300))));
}

TEST(Compress, TablesWithoutAMeasurementHaveNoData) {
  Measurement m = bumpy_measurement({8, 4, 6});
  auto& table = std::get<HalfDifferenceTable>(m.table);
  std::fill(table.valid.begin(), table.valid.end(), std::uint8_t{0});
  expect_error(ErrorCode::no_data, {}, [&] { compress(m, quick()); });
}

TEST(Compress, BlackTables) {
  const Measurement m = test::small_measurement(
      {12, 6, 8}, 3, [](const Vec3d&, const Vec3d&, std::span<double> f) { std::fill(f.begin(), f.end(), 0.0); });
  try {
    const Material material = decoded(compress(m, quick()));
    float f[3];
    material.eval({0, 0, 1}, {0, 0.6F, 0.8F}, f);
    for (const float v : f) EXPECT_LT(v, 1e-3F);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::no_data) << e.what();
  }
}

TEST(Compress, CanBeCancelledAtEveryStage) {
  const Measurement m = bumpy_measurement({12, 6, 8});
  int calls = 0;
  compress(m, quick_size(300), [&](std::string_view, double done) {
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    ++calls;
    return true;
  });
  ASSERT_GT(calls, 2);
  for (int stop = 1; stop <= calls; ++stop) {
    int seen = 0;
    expect_error(ErrorCode::cancelled, {},
                 [&] { compress(m, quick_size(300), [&](std::string_view, double) { return ++seen < stop; }); });
  }
}

TEST(EncodeOptions, InvalidOnesAreRefusedWithAReason) {
  const auto refused = [](auto&& change, const char* word) {
    EncodeOptions o;
    change(o);
    std::string why;
    EXPECT_FALSE(o.is_valid(&why));
    EXPECT_FALSE(o.is_valid());
    EXPECT_NE(why.find(word), std::string::npos) << why;
    expect_error(ErrorCode::invalid_argument, {word}, [&] { compress(Measurement{}, o); });
  };
  refused([](EncodeOptions& o) { o.effort = -1; }, "effort");
  refused([](EncodeOptions& o) { o.effort = 101; }, "effort");
  refused([](EncodeOptions& o) { o.threads = 0; }, "threads");
  refused(
      [](EncodeOptions& o) {
        o.target_size = 100;
        o.target_error = ErrorTarget{};
      },
      "exclude");
  refused([](EncodeOptions& o) { o.target_error = ErrorTarget{Metric::log_mae, -1}; }, "target error");
  refused([](EncodeOptions& o) { o.target_error = ErrorTarget{Metric::log_mae, std::nan("")}; }, "target error");
  EXPECT_TRUE(EncodeOptions{}.is_valid());
}

TEST(Presets, AreFiveSoundPointsOfTheEffortScale) {
  ASSERT_EQ(presets().size(), 5U);
  int before = -1;
  for (const Preset& p : presets()) {
    EXPECT_GT(p.effort, before);
    EXPECT_FALSE(p.name.empty());
    EXPECT_FALSE(p.purpose.empty());
    EncodeOptions o;
    o.effort = before = p.effort;
    EXPECT_TRUE(o.is_valid());
  }
  EXPECT_EQ(before, 100);
}

}  // namespace
}  // namespace brdf
