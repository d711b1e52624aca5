// SPDX-License-Identifier: Apache-2.0
// Nanoseconds per query, for `bench`. Every batch and every repeat takes other pairs of a pool, so that a table is read
// where the pairs fall and not where the last ones have left it in the cache.
#pragma once

#include "bench_row.h"

#include "peers/neural_brdf.h"
#include "peers/raw_table.h"

namespace brdf::cli {

/// Of one evaluation, pair by pair, as a path tracer asks.
double single_eval_nanoseconds(const Material& m);

/// Fills the columns of eval, pdf and sample.
void measure_speed(const Material& m, BenchRow& row);
/// Fills the columns of eval.
void measure_speed(const peers::NeuralBrdf& network, BenchRow& row);

struct EvalSpeed {
  double batch = not_measured, scalar = not_measured;  ///< ns per pair
};

EvalSpeed eval_speed(const peers::RawTable& table);

}  // namespace brdf::cli
