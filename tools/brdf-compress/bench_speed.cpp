// SPDX-License-Identifier: Apache-2.0
#include "bench_speed.h"

#include "counter_random.h"
#include "stopwatch.h"
#include "test_pairs.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace brdf::cli {
namespace {

constexpr std::size_t batch = 4096, batches = 64;
constexpr std::uint64_t pair_seed = 1, sample_seed = 2;

DirectionSpan part(const DirectionPlanes& planes, std::size_t first) {
  const DirectionSpan all = planes.span();
  return {all.x + first, all.y + first, all.z + first, batch};
}

/// Pairs of directions and random numbers; the same in every run.
class Pool {
 public:
  static const Pool& shared() {
    static const Pool pool;
    return pool;
  }

  /// Nanoseconds per query of `work(first)`, which handles the queries from `first` on, one batch of them.
  template <class Work>
  double nanoseconds(Work&& work) const {
    std::size_t next = 0;
    const double seconds = undisturbed_seconds([&] {
      work(next * batch);
      next = (next + 1) % batches;
    });
    return seconds * 1e9 / batch;
  }
  /// The same for `work(i)`, which handles one query.
  template <class Work>
  double nanoseconds_scalar(Work&& work) const {
    return nanoseconds([&](std::size_t first) {
      for (std::size_t i = first; i < first + batch; ++i) work(i);
    });
  }

  DirectionPlanes wi, wo, u;

 private:
  Pool() : u(batch * batches) {
    TestPairs pairs = random_pairs(batch * batches, pair_seed);
    wi = std::move(pairs.wi);
    wo = std::move(pairs.wo);
    const CounterRandom random(sample_seed);
    for (std::size_t i = 0; i < u.size(); ++i)
      u.set(i, {random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2)});
  }
};

/// Of anything of three channels that evaluates batches and single pairs.
template <class Peer>
EvalSpeed eval_speed_of(const Peer& peer) {
  const Pool& pool = Pool::shared();
  std::vector<float> f(3 * batch);
  std::array<float, 3> one{};
  EvalSpeed speed;
  speed.batch = pool.nanoseconds([&](std::size_t first) {
    peer.eval(part(pool.wi, first), part(pool.wo, first), {f.data(), batch});
  });
  speed.scalar = pool.nanoseconds_scalar(
      [&](std::size_t i) { peer.eval(pool.wi.get(i), pool.wo.get(i), std::span<float, 3>(one)); });
  return speed;
}

}  // namespace

double single_eval_nanoseconds(const Material& m) {
  const Pool& pool = Pool::shared();
  std::vector<float> f(static_cast<std::size_t>(m.channels()));
  return pool.nanoseconds_scalar([&](std::size_t i) { m.eval(pool.wi.get(i), pool.wo.get(i), f); });
}

void measure_speed(const Material& m, BenchRow& row) {
  const Pool& pool = Pool::shared();
  const auto channels = static_cast<std::size_t>(m.channels());
  DirectionPlanes drawn(batch);
  std::vector<float> f(batch * channels), pdf(batch);
  const std::span<float> one = std::span(f).first(channels);
  const auto wi = [&](std::size_t first) { return part(pool.wi, first); };
  const auto wo = [&](std::size_t first) { return part(pool.wo, first); };
  row.eval_ns = pool.nanoseconds([&](std::size_t first) { m.eval(wi(first), wo(first), {f.data(), batch}); });
  row.pdf_ns = pool.nanoseconds([&](std::size_t first) { m.pdf(wi(first), wo(first), pdf.data()); });
  row.sample_ns = pool.nanoseconds([&](std::size_t first) {
    m.sample(wo(first), part(pool.u, first), drawn.span(), pdf.data(), {f.data(), batch});
  });
  row.eval_ns_scalar = pool.nanoseconds_scalar([&](std::size_t i) { m.eval(pool.wi.get(i), pool.wo.get(i), one); });
  row.pdf_ns_scalar =
      pool.nanoseconds_scalar([&](std::size_t i) { pdf[i % batch] = m.pdf(pool.wi.get(i), pool.wo.get(i)); });
  row.sample_ns_scalar = pool.nanoseconds_scalar(
      [&](std::size_t i) { pdf[i % batch] = m.sample(pool.wo.get(i), pool.u.get(i), one).pdf; });
}

void measure_speed(const peers::NeuralBrdf& network, BenchRow& row) {
  const EvalSpeed speed = eval_speed_of(network);
  row.eval_ns = speed.batch;
  row.eval_ns_scalar = speed.scalar;
}

EvalSpeed eval_speed(const peers::RawTable& table) { return eval_speed_of(table); }

}  // namespace brdf::cli
