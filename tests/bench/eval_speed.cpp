// SPDX-License-Identifier: Apache-2.0
// Nanoseconds per pair of eval, pdf and sample: single calls, and batches on every instruction set of the machine.
#include "base/highway_targets.h"
#include "support/direction_batch.h"
#include "support/synthetic_grid.h"

#include <benchmark/benchmark.h>
#include <hwy/highway.h>

#include <array>
#include <functional>
#include <string>

namespace {

using namespace brdf;

constexpr std::size_t pairs = 4096;

struct Bench {
  Material material;
  test::DirectionBatch wi = test::random_directions(pairs, 1), wo = test::random_directions(pairs, 2);
  test::DirectionBatch u = test::random_numbers(pairs, 3), drawn{pairs};
  std::vector<float> f = std::vector<float>(pairs * static_cast<std::size_t>(material.channels()));
  std::vector<float> pdf = std::vector<float>(pairs);
  PlanarSpan planes() { return {f.data(), pairs}; }
  std::span<float> row(std::size_t i) {
    const auto n = static_cast<std::size_t>(material.channels());
    return std::span(f).subspan(i * n, n);
  }
};

using Work = void (*)(Bench&);

void eval_single(Bench& b) {
  for (std::size_t i = 0; i < pairs; ++i) b.material.eval(b.wi[i], b.wo[i], b.row(i));
}
void pdf_single(Bench& b) {
  for (std::size_t i = 0; i < pairs; ++i) b.pdf[i] = b.material.pdf(b.wi[i], b.wo[i]);
}
void sample_single(Bench& b) {
  for (std::size_t i = 0; i < pairs; ++i) b.pdf[i] = b.material.sample(b.wo[i], b.u[i], b.row(i)).pdf;
}
void eval_batch(Bench& b) { b.material.eval(b.wi.span(), b.wo.span(), b.planes()); }
void pdf_batch(Bench& b) { b.material.pdf(b.wi.span(), b.wo.span(), b.pdf.data()); }
void eval_pdf_batch(Bench& b) { b.material.eval_pdf(b.wi.span(), b.wo.span(), b.planes(), b.pdf.data()); }
void sample_batch(Bench& b) {
  b.material.sample(b.wo.span(), b.u.span(), b.drawn.writable(), b.pdf.data(), b.planes());
}

void add(const std::string& name, Bench& b, Work work, std::int64_t target) {
  benchmark::RegisterBenchmark(name.c_str(), [&b, work, target](benchmark::State& state) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (auto _ : state) {
      work(b);
      benchmark::ClobberMemory();
    }
    // printed as time per pair
    state.counters["pair"] = benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsIterationInvariantRate |
                                                                                benchmark::Counter::kInvert);
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  });
}

}  // namespace

int main(int argc, char** argv) {
  static std::array<Bench, 3> materials = {Bench{test::material_of(test::usual_lobes())},
                                           Bench{test::material_of(test::usual_lobes(), test::synthetic_grid({}))},
                                           Bench{test::material_of(test::usual_lobes(31), test::synthetic_grid({16, 16, 12, 31}))}};
  const std::array<std::string, 3> names = {"lobes", "grid", "spectral31"};
  for (std::size_t m = 0; m < materials.size(); ++m) {
    Bench& b = materials[m];
    add("eval/" + names[m] + "/single", b, eval_single, 0);
    add("pdf/" + names[m] + "/single", b, pdf_single, 0);
    add("sample/" + names[m] + "/single", b, sample_single, 0);
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
      const std::int64_t target = rest & -rest;
      const std::string end = "/" + names[m] + "/" + hwy::TargetName(target);
      add("eval" + end, b, eval_batch, target);
      add("pdf" + end, b, pdf_batch, target);
      add("eval_pdf" + end, b, eval_pdf_batch, target);
      add("sample" + end, b, sample_batch, target);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
