// SPDX-License-Identifier: Apache-2.0
#include "bench_measure.h"

#include "compressed_file.h"
#include "counter_random.h"
#include "material_checks.h"
#include "stopwatch.h"
#include "test_pairs.h"

#include <algorithm>
#include <utility>

namespace brdf::cli {
namespace {

constexpr std::size_t batch = 4096;
constexpr std::uint64_t pair_seed = 1, sample_seed = 2;

double nanoseconds(double seconds_per_batch) { return seconds_per_batch * 1e9 / batch; }

double raw_nanoseconds(const MaterialSource& source) {
  const TestPairs pairs = random_pairs(batch, pair_seed);
  std::vector<double> f(static_cast<std::size_t>(source.channels().count));
  return nanoseconds(median_seconds([&] {
    for (std::size_t i = 0; i < batch; ++i) source.eval(Vec3d(pairs.wi.get(i)), Vec3d(pairs.wo.get(i)), f);
  }));
}

void measure_speed(const Material& m, BenchRow& row) {
  const TestPairs pairs = random_pairs(batch, pair_seed);
  const CounterRandom random(sample_seed);
  const auto channels = static_cast<std::size_t>(m.channels());
  DirectionPlanes u(batch), drawn(batch);
  for (std::size_t i = 0; i < batch; ++i) u.set(i, {random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2)});
  std::vector<float> f(batch * channels), pdf(batch);
  const DirectionSpan wi = pairs.wi.span(), wo = pairs.wo.span();
  const std::span<float> one = std::span(f).first(channels);
  row.eval_ns = nanoseconds(median_seconds([&] { m.eval(wi, wo, {f.data(), batch}); }));
  row.pdf_ns = nanoseconds(median_seconds([&] { m.pdf(wi, wo, pdf.data()); }));
  row.sample_ns = nanoseconds(median_seconds([&] {
    m.sample(wo, std::as_const(u).span(), drawn.span(), pdf.data(), {f.data(), batch});
  }));
  row.eval_ns_scalar = nanoseconds(median_seconds([&] {
    for (std::size_t i = 0; i < batch; ++i) m.eval(pairs.wi.get(i), pairs.wo.get(i), one);
  }));
  row.sample_ns_scalar = nanoseconds(median_seconds([&] {
    for (std::size_t i = 0; i < batch; ++i) pdf[i] = m.sample(pairs.wo.get(i), u.get(i), one).pdf;
  }));
}

bool same_values(const Material& a, const Material& b) {
  const TestPairs pairs = make_test_pairs();
  const std::size_t n = pairs.wi.size() * static_cast<std::size_t>(a.channels());
  std::vector<float> f(n), g(n);
  a.eval(pairs.wi.span(), pairs.wo.span(), {f.data(), pairs.wi.size()});
  b.eval(pairs.wi.span(), pairs.wo.span(), {g.data(), pairs.wi.size()});
  return f == g;
}

int count_bugs(const EncodeResult& encoded, const BenchSetting& setting, const BenchRow& row, const std::string& path) {
  const auto decode = [&] { return decode_file(encoded.bytes, row.level, false, path); };
  const Material m = decode();
  int bugs = 0;
  bugs += setting.target_size && encoded.bytes.size() > *setting.target_size ? 1 : 0;
  bugs += encoded.summary.bytes != encoded.bytes.size() ? 1 : 0;
  bugs += same_values(m, decode()) ? 0 : 1;
  bugs += row.errors.not_finite > 0 ? 1 : 0;
  bugs += row.errors.negative > 0 ? 1 : 0;
  bugs += prefix_check(encoded.bytes, path).ok ? 0 : 1;
  for (const Check& check : value_checks(m)) bugs += check.ok ? 0 : 1;
  return bugs;
}

}  // namespace

BenchMaterial::BenchMaterial(const MaterialSource& source, int threads)
    : source_(source),
      threads_(threads),
      comparison_(source.rows(), source.channels().count, 1.0, threads),
      native_bytes_(4.0 * static_cast<double>(report(source.measurement()).numbers)),
      raw_eval_ns_(raw_nanoseconds(source)) {}

BenchRow BenchMaterial::measure_level(const EncodeResult& encoded, EvalLevel level) const {
  BenchRow row;
  row.material = source_.measurement().provenance.name;
  row.level = level;
  row.bytes = encoded.bytes.size();
  row.ratio = static_cast<double>(source_.file_bytes()) / static_cast<double>(row.bytes);
  row.ratio_native = native_bytes_ / static_cast<double>(row.bytes);
  const Material m = decode_file(encoded.bytes, level, false, source_.path());
  row.decode_us = 1e6 * median_seconds([&] { decode_file(encoded.bytes, level, false, source_.path()); });
  row.resident_bytes = m.resident_bytes();
  measure_speed(m, row);
  row.raw_eval_ns = row.raw_eval_ns_scalar = raw_eval_ns_;
  row.errors = comparison_.score(batch_rows(m));
  row.simd = simd_target();
  row.threads = threads_;
  return row;
}

std::vector<BenchRow> BenchMaterial::measure(const BenchSetting& setting, std::span<const EvalLevel> levels) const {
  EncodeOptions options;
  options.effort = setting.effort;
  options.target_size = setting.target_size;
  options.threads = threads_;
  const Stopwatch watch;
  const EncodeResult encoded = compress(source_.measurement(), options);
  const double encode_s = watch.seconds();
  std::vector<BenchRow> rows;
  for (const EvalLevel level : levels) {
    BenchRow row = measure_level(encoded, level);
    row.preset = setting.preset;
    row.effort = setting.effort;
    row.target = setting.target_size;
    row.encode_s = encode_s;
    row.bugs = count_bugs(encoded, setting, row, source_.path());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace brdf::cli
