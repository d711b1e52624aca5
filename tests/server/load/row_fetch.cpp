// SPDX-License-Identifier: Apache-2.0
#include "server/load/latency.h"
#include "server/load/rows.h"
#include "shared/float_bytes.h"

#include <brdf/client/client.h>

namespace brdf::load {
namespace {

/// Nanoseconds a pair of a batch that stays in the cache.
double nanoseconds(const Material& material, const std::vector<float>& wi, const std::vector<float>& wo, std::vector<float>& f) {
  const std::size_t n = wi.size() / 3;
  const auto span = [n](const std::vector<float>& v) { return DirectionSpan{v.data(), v.data() + n, v.data() + 2 * n, n}; };
  constexpr int repeats = 20;
  const auto start = Clock::now();
  for (int i = 0; i < repeats; ++i) material.eval(span(wi), span(wo), {f.data(), n});
  return 1e9 * seconds_since(start) / (repeats * static_cast<double>(n));
}

std::vector<float> floats_of(const std::string& bytes) {
  std::vector<float> values(bytes.size() / sizeof(float));
  service::load_floats(bytes, 0, values);
  return values;
}

}  // namespace

std::vector<Row> measure_fetch(Setup& setup) {
  const std::vector<std::byte>& bytes = setup.default_material();
  Served served = setup.serve({{"a", bytes}});
  client::ClientOptions options;
  options.servers = {served.address};
  const int opens = setup.is_long ? 200 : 20;
  std::vector<double> cold, fetches, sampling;
  DecodeOptions evaluation;
  evaluation.sampling = false;  // what is evaluated needs no tables to sample from
  client::Client connected(options);
  for (int i = 0; i < opens; ++i) {
    const auto start = Clock::now();
    client::Client fresh(options);
    const Material material = fresh.open("materials/a", evaluation);
    cold.push_back(seconds_since(start));
    const auto again = Clock::now();
    connected.open("materials/a");
    sampling.push_back(seconds_since(again));
    const auto fetch = Clock::now();
    connected.fetch("materials/a");
    fetches.push_back(seconds_since(fetch));
  }
  const Material fetched = connected.open("materials/a", evaluation), library = Material::decode(bytes, evaluation);
  const std::size_t n = 4096;
  const std::vector<float> wi = floats_of(direction_planes(n, 1)), wo = floats_of(direction_planes(n, 2));
  std::vector<float> f(n * static_cast<std::size_t>(library.channels())), g = f;
  std::vector<double> ours, own, ratios;
  for (int i = 0; i < (setup.is_long ? 200 : 30); ++i) {
    own.push_back(nanoseconds(library, wi, wo, f));
    ours.push_back(nanoseconds(fetched, wi, wo, g));
    ratios.push_back(ours.back() / own.back());
  }
  const double p50 = median(cold), ratio = median(ratios);
  Row row;
  row.name = "fetch and evaluate here";
  row.asked = "cold under 5 ms for a default material, then the library's own ns";
  row.reached = duration(p50) + " cold (p95 " + duration(quantile(cold, 0.95)) + "; the call alone " + duration(median(fetches)) + ", with tables to sample from " + duration(median(sampling)) + "), then " +
                number(median(ours)) + " ns a pair, " + number(ratio) + " times the library's";
  row.ran = std::to_string(opens) + " new clients: connect, fetch " + std::to_string(bytes.size()) + " bytes, decode; batches of " + std::to_string(n) + " pairs by turns; medians";
  row.sound = f == g;
  row.met = p50 < 5e-3 && ratio < 1.1;
  row.figures = {{"cold_seconds", p50}, {"cold_p95_seconds", quantile(cold, 0.95)}, {"sampling_seconds", median(sampling)}, {"call_seconds", median(fetches)}, {"nanoseconds", median(ours)}, {"ratio", ratio}};
  return {row};
}

}  // namespace brdf::load
