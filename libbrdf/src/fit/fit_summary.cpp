// SPDX-License-Identifier: Apache-2.0
#include <brdf/fit.h>

#include <algorithm>
#include <cstdio>

namespace brdf {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

}  // namespace

std::string FitSummary::brief() const {
  const auto kept = std::count_if(lobes.begin(), lobes.end(), [](const LobeReason& r) { return r.kept; });
  return text("%d lobe%s, cost %.6g, %d solver runs, %.3f s (solver %.3f s); ", static_cast<int>(kept),
              kept == 1 ? "" : "s", cost, solver_runs, seconds_total, seconds_solver) +
         stop_reason;
}

std::string FitSummary::full() const {
  std::string all = brief() + "\n";
  for (const LobeReason& r : lobes) all += "  " + r.sentence + "\n";
  return all + "  solver: " + solver_message + "\n";
}

}  // namespace brdf
