// SPDX-License-Identifier: Apache-2.0
// The same answers from every instruction set and any number of threads. Optimisation levels: compare_builds.py.
#include "support/direction_kinds.h"
#include "extremes/smooth_grid.h"
#include "support/numeric_bound.h"
#include "support/simd_targets.h"
#include "support/small_measurement.h"
#include "support/synthetic_grid.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace brdf::test {
namespace {

const char* const group = "Agreement";
NumericBound lobes_differ(group, "instruction sets, lobes: f from that of the first set", "relative", 4e-6);
NumericBound grid_differ(group, "instruction sets, lobes and residual: f from that of the first set, per f + epsilon", "relative", 2e-4);
NumericBound files(group, "compress with 1, 2, 3 and 7 threads and every instruction set: bytes that differ", "count", 0);
NumericBound at_once(group, "four threads evaluating one material: values whose bits differ from one thread's", "count", 0);

/// Batches over all kinds of directions, one after the other.
std::vector<float> all_values(const Material& m) {
  std::vector<float> all;
  for (const DirectionKind& k : direction_kinds()) {
    const std::size_t n = k.wi.size(), channels = static_cast<std::size_t>(m.channels());
    std::vector<float> f(channels * n);
    m.eval(k.wi.span(), k.wo.span(), {f.data(), n});
    all.insert(all.end(), f.begin(), f.end());
  }
  return all;
}

void compare_targets(const Material& m, double floor, NumericBound& bound) {
  std::vector<float> first;
  std::string name;
  on_every_target([&] {
    const std::vector<float> f = all_values(m);
    if (first.empty()) {
      first = f;
      name = simd_target();
    }
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double a = static_cast<double>(first[i]), b = static_cast<double>(f[i]);
      bound.see(a == b ? 0 : std::fabs(a - b) / (a + floor), [&] { return name + " against " + simd_target(); });
    }
  });
}

TEST(Agreement, InstructionSets) {
  for (const LobeSet& lobes : {usual_lobes(), LobeSet{3, {ggx_lobe(3, 1e-5, 0.9), ggx_lobe(3, 0.01, 0.4, 1, true)}}, usual_lobes(31)})
    compare_targets(Material::from_lobes(lobes), 0, lobes_differ);
  for (const auto azimuth : {residual::Azimuth::one_way, residual::Azimuth::symmetric, residual::Azimuth::reciprocal}) {
    const residual::ResidualGrid grid = smooth_grid(azimuth);
    compare_targets(material_of(usual_lobes(), grid), static_cast<double>(grid.epsilon), grid_differ);
  }
  lobes_differ.check();
  grid_differ.check();
}

TEST(AgreementSlow, ThreadsAndInstructionSetsWriteTheSameBytes) {
  double different = 0;
  for (const Measurement& m : {bumpy_measurement({12, 6, 8}), bumpy_measurement({9, 7, 10, true}, 4, 0.4)}) {
    EncodeOptions options;
    options.effort = 0;
    options.target_size = 300;
    const std::vector<std::byte> expected = compress(m, options).bytes;
    const auto see = [&](const std::string& where) {
      const std::vector<std::byte> bytes = compress(m, options).bytes;
      std::size_t same = 0;
      while (same < std::min(bytes.size(), expected.size()) && bytes[same] == expected[same]) ++same;
      different += static_cast<double>(std::max(bytes.size(), expected.size()) - same);
      files.see(different, [&] { return where; });
    };
    for (const int threads : {2, 3, 7}) {
      options.threads = threads;
      see(std::to_string(threads) + " threads");
    }
    options.threads = 1;
    on_every_target([&] { see(simd_target()); });
  }
  files.check();
}

TEST(Agreement, ThreadsEvaluateTheSame) {
  const Material m = material_of(usual_lobes(), smooth_grid(residual::Azimuth::symmetric));
  const std::vector<float> expected = all_values(m);
  std::vector<std::vector<float>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<float>& f : found) threads.emplace_back([&m, &f] { f = all_values(m); });
  for (std::thread& t : threads) t.join();
  double different = 0;
  for (const std::vector<float>& f : found) {
    ASSERT_EQ(f.size(), expected.size());
    for (std::size_t i = 0; i < f.size(); ++i) different += f[i] == expected[i] ? 0 : 1;
    at_once.see(different, [] { return std::string("a thread"); });
  }
  at_once.check();
}

}  // namespace
}  // namespace brdf::test
