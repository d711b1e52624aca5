// SPDX-License-Identifier: Apache-2.0
#include "bench_measure.h"

#include "compressed_file.h"
#include "material_checks.h"
#include "stopwatch.h"
#include "test_pairs.h"

#include <optional>
#include <utility>
#include <variant>

namespace brdf::cli {
namespace {

/// The measurement as a renderer would hold it, which is in RGB.
std::optional<peers::RawTable> raw_table(const Measurement& m) {
  if (m.channels.count != 3) return std::nullopt;
  const auto* table = std::get_if<HalfDifferenceTable>(&m.table);
  return std::optional<peers::RawTable>(std::in_place, table != nullptr ? *table : peers::resample_to_merl(m));
}

bool same_values(const Material& a, const Material& b) {
  const TestPairs pairs = make_test_pairs();
  const std::size_t n = pairs.wi.size() * static_cast<std::size_t>(a.channels());
  std::vector<float> f(n), g(n);
  a.eval(pairs.wi.span(), pairs.wo.span(), {f.data(), pairs.wi.size()});
  b.eval(pairs.wi.span(), pairs.wo.span(), {g.data(), pairs.wi.size()});
  return f == g;
}

int count_bugs(const EncodeResult& encoded, const BenchSetting& setting, const BenchRow& row, EvalLevel level,
               const std::string& path) {
  const auto decode = [&] { return decode_file(encoded.bytes, level, false, path, true); };
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
      raw_(raw_table(source.measurement())) {}

BenchRow BenchMaterial::begin_row(std::uint64_t bytes) const {
  BenchRow row;
  row.material = source_.measurement().provenance.name;
  row.bytes = bytes;
  row.ratio = static_cast<double>(source_.file_bytes()) / static_cast<double>(bytes);
  row.ratio_native = native_bytes_ / static_cast<double>(bytes);
  if (raw_) {  // beside each row, because a machine is not equally busy all the time
    const EvalSpeed raw = eval_speed(*raw_);
    row.raw_eval_ns = raw.batch;
    row.raw_eval_ns_scalar = raw.scalar;
  }
  row.simd = simd_target();
  row.threads = threads_;
  return row;
}

BenchRow BenchMaterial::measure_level(const EncodeResult& encoded, EvalLevel level) const {
  BenchRow row = begin_row(encoded.bytes.size());
  row.level = level;
  const Material m = decode_file(encoded.bytes, level, false, source_.path(), true);
  row.decode_us = 1e6 * undisturbed_seconds([&] { decode_file(encoded.bytes, level, false, source_.path()); });
  row.resident_bytes = m.resident_bytes();
  measure_speed(m, row);
  row.errors = comparison_.score(batch_rows(m));
  return row;
}

BenchRow BenchMaterial::measure(const peers::NeuralBrdf& network) const {
  BenchRow row = begin_row(peers::NeuralBrdf::bytes);
  row.preset = "neural";
  row.resident_bytes = peers::NeuralBrdf::bytes;
  measure_speed(network, row);
  row.errors = comparison_.score(batch_rows(network));
  row.bugs = (row.errors.not_finite > 0 ? 1 : 0) + (row.errors.negative > 0 ? 1 : 0);
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
    row.bugs = count_bugs(encoded, setting, row, level, source_.path());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace brdf::cli
