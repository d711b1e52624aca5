// SPDX-License-Identifier: Apache-2.0
// The rows of the load test. Each starts the processes that it needs and ends them.
#pragma once

#include "server/load/setup.h"

#include <functional>
#include <string>
#include <vector>

namespace brdf::load {

std::vector<Row> measure_throughput(Setup& setup);   ///< large batches against the echo service
std::vector<Row> measure_small_call(Setup& setup);   ///< one client, one small call against the echo service
std::vector<Row> measure_fetch(Setup& setup);        ///< fetch once, evaluate here
std::vector<Row> measure_overload(Setup& setup);     ///< ten times what it can do
std::vector<Row> measure_replicas(Setup& setup);     ///< replicas that are killed or drained
std::vector<Row> measure_swaps(Setup& setup);        ///< new versions under load
std::vector<Row> measure_hostile(Setup& setup);      ///< clients that mean harm beside honest ones
std::vector<Row> measure_flood(Setup& setup);        ///< streams that are reset as fast as they are taken
std::vector<Row> measure_soak(Setup& setup);         ///< everything for minutes: memory and descriptors
std::vector<Row> measure_compress(Setup& setup);     ///< compressions that are killed, and a full disk

struct NamedRow {
  std::string name;
  std::function<std::vector<Row>(Setup&)> measure;
};
const std::vector<NamedRow>& all_rows();

}  // namespace brdf::load
