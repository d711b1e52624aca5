// SPDX-License-Identifier: Apache-2.0
// What fit_lobes promises besides good lobes.
#include "fit_synthetic.h"

#include <brdf/error.h>
#include <brdf/fit.h>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace brdf::fit {
namespace {

LobeSet coated() {
  return {3, {{LobeKind::lambert, 1, 1, {0.3, 0.2, 0.1}}, {LobeKind::ggx, 0.1, 1, {0.04, 0.04, 0.04}}}};
}

void expect_identical(const LobeSet& a, const LobeSet& b) {
  ASSERT_EQ(a.lobes.size(), b.lobes.size());
  for (std::size_t l = 0; l < a.lobes.size(); ++l) {
    EXPECT_EQ(a.lobes[l].kind, b.lobes[l].kind);
    EXPECT_EQ(a.lobes[l].alpha, b.lobes[l].alpha);
    EXPECT_EQ(a.lobes[l].f90, b.lobes[l].f90);
    EXPECT_EQ(a.lobes[l].color, b.lobes[l].color);
  }
}

ErrorCode code_of(const Measurement& m, const Progress& progress = {}) {
  try {
    fit_lobes(m, {}, progress);
  } catch (const Error& e) {
    return e.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorCode::io;
}

TEST(FitContract, ThreadsDoNotChangeTheBits) {
  const Measurement m = table_of(coated(), 1, 0.05);
  FitOptions o;
  o.samples = 2000;
  const FitResult one = fit_lobes(m, o);
  for (const int threads : {2, 5}) {
    o.threads = threads;
    const FitResult many = fit_lobes(m, o);
    expect_identical(one.lobes, many.lobes);
    EXPECT_EQ(one.summary.cost, many.summary.cost);
    EXPECT_EQ(one.summary.solver_runs, many.summary.solver_runs);
    ASSERT_EQ(one.summary.lobes.size(), many.summary.lobes.size());
    for (std::size_t i = 0; i < one.summary.lobes.size(); ++i) {
      EXPECT_EQ(one.summary.lobes[i].sentence, many.summary.lobes[i].sentence);
    }
  }
}

TEST(FitContract, MaskedCellsDoNotMatter) {
  const Measurement clean = table_of(coated());
  Measurement a = clean, b = clean;
  const auto spoil = [](Measurement& m, float value) {
    auto& t = std::get<HalfDifferenceTable>(m.table);
    for (std::size_t cell = 0; cell < t.valid.size(); ++cell) {
      const std::size_t theta_d = cell / 60 % 45;
      if (theta_d < 10 || theta_d > 20) continue;  // a whole zone is missing
      t.valid[cell] = 0;
      for (std::size_t c = 0; c < 3; ++c) t.values[cell * 3 + c] = value;
    }
  };
  spoil(a, -1.0F);
  spoil(b, 1e30F);
  const FitResult ra = fit_lobes(a), rb = fit_lobes(b), whole = fit_lobes(clean);
  expect_identical(ra.lobes, rb.lobes);
  ASSERT_EQ(ra.lobes.lobes.size(), 2U);
  EXPECT_NEAR(ra.lobes.lobes[1].alpha, whole.lobes.lobes[1].alpha, 0.002);
}

TEST(FitContract, AllZeroIsOneBlackLambert) {
  LobeSet black = coated();
  for (Lobe& lobe : black.lobes) lobe.color = {0, 0, 0}, lobe.f90 = 0;
  const FitResult r = fit_lobes(table_of(black));
  ASSERT_EQ(r.lobes.lobes.size(), 1U);
  EXPECT_EQ(r.lobes.lobes[0].kind, LobeKind::lambert);
  EXPECT_EQ(r.lobes.lobes[0].color, (std::vector<double>{0, 0, 0}));
  EXPECT_NE(r.summary.stop_reason.find("every valid sample is 0"), std::string::npos);
}

TEST(FitContract, NothingMeasuredIsNoData) {
  Measurement m = table_of(coated());
  auto& t = std::get<HalfDifferenceTable>(m.table);
  std::fill(t.valid.begin(), t.valid.end(), std::uint8_t{0});
  EXPECT_EQ(code_of(m), ErrorCode::no_data);
}

TEST(FitContract, FewMeasuredCellsStillGiveLobes) {
  Measurement m = table_of(coated());
  auto& t = std::get<HalfDifferenceTable>(m.table);
  for (std::size_t cell = 0; cell < t.valid.size(); ++cell) {
    if (cell / (45 * 60) != 40 || cell / 60 % 45 != 10) t.valid[cell] = 0;
  }
  const FitResult r = fit_lobes(m);
  ASSERT_FALSE(r.lobes.lobes.empty());
  for (const Lobe& lobe : r.lobes.lobes) {
    for (const double c : lobe.color) EXPECT_TRUE(std::isfinite(c) && c >= 0);
  }
}

TEST(FitContract, ProgressRisesOnTheCallersThreadAndEndsAtOne) {
  const auto caller = std::this_thread::get_id();
  double last = 0;
  int calls = 0;
  bool rises = true, here = true;
  FitOptions o;
  o.threads = 3;
  fit_lobes(table_of(coated()), o, [&](std::string_view stage, double done) {
    EXPECT_EQ(stage, "fit");
    rises = rises && done >= last && done <= 1;
    here = here && std::this_thread::get_id() == caller;
    last = done;
    ++calls;
    return true;
  });
  EXPECT_TRUE(rises);
  EXPECT_TRUE(here);
  EXPECT_EQ(last, 1);
  EXPECT_GT(calls, 20);
}

TEST(FitContract, CancelsAtTheNextCallAndPassesExceptionsOn) {
  const Measurement m = table_of(coated());
  for (const int at : {1, 2, 30}) {
    int calls = 0;
    EXPECT_EQ(code_of(m, [&](std::string_view, double) { return ++calls < at; }), ErrorCode::cancelled);
    EXPECT_EQ(calls, at);
  }
  int calls = 0;
  EXPECT_THROW(fit_lobes(m, {},
                         [&](std::string_view, double) -> bool {
                           if (++calls == 5) throw std::domain_error("mine");
                           return true;
                         }),
               std::domain_error);
}

TEST(FitContract, SummaryAddsUp) {
  const FitResult r = fit_lobes(table_of(coated(), 1, 0.03));
  const FitSummary& s = r.summary;
  std::size_t kept = 0;
  for (const LobeReason& l : s.lobes) {
    kept += l.kept ? 1 : 0;
    EXPECT_TRUE(!l.kept || l.criterion_after < l.criterion_before) << l.sentence;
    EXPECT_FALSE(l.sentence.empty());
    EXPECT_NE(s.full().find(l.sentence), std::string::npos);
  }
  EXPECT_EQ(kept, r.lobes.lobes.size());
  EXPECT_GT(s.cost, 0);
  EXPECT_GT(s.solver_runs, 2);
  EXPECT_GT(s.seconds_solver, 0);
  EXPECT_GE(s.seconds_total, s.seconds_solver);
  EXPECT_EQ(s.brief().find('\n'), std::string::npos);
  EXPECT_NE(s.brief().find("2 lobes"), std::string::npos);
}

TEST(FitContract, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  fit_lobes(table_of(coated(), 1e-30, 0.2));
  fit_lobes(table_of({1, {{LobeKind::ggx, 1e-4, 0, {1}}}}));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace brdf::fit
