// SPDX-License-Identifier: Apache-2.0
#include "rpc/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace brdf::service {
namespace {

constexpr std::array method_names{"ListMaterials", "GetMaterial", "DownloadMaterial", "Evaluate", "EvaluateStream", "Albedo",
                                  "FindSimilar", "Compress", "WatchMaterials", "LoadMaterial", "UnloadMaterial", "ReloadRepository"};
static_assert(method_names.size() == method_count);
constexpr std::array code_names{"OK", "CANCELLED", "UNKNOWN", "INVALID_ARGUMENT", "DEADLINE_EXCEEDED", "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED",
                                "FAILED_PRECONDITION", "ABORTED", "OUT_OF_RANGE", "UNIMPLEMENTED", "INTERNAL", "UNAVAILABLE", "DATA_LOSS", "UNAUTHENTICATED"};

struct Gauge {
  std::string name, help;
  std::function<double()> value;
};

}  // namespace

const char* to_string(Method method) noexcept { return method_names[static_cast<std::size_t>(method)]; }

struct Metrics::State : prometheus::Collectable {
  prometheus::Registry registry;
  std::array<std::array<prometheus::Counter*, code_names.size()>, method_count> calls{};
  std::array<prometheus::Histogram*, method_count> seconds{};
  std::array<prometheus::Counter*, 3> queries{};
  prometheus::Family<prometheus::Counter>* refused = nullptr;
  prometheus::Counter *downloaded = nullptr, *swapped = nullptr, *bad_files = nullptr, *cut = nullptr;
  mutable std::mutex mutex;
  std::vector<Gauge> gauges;

  std::vector<prometheus::MetricFamily> Collect() const override {
    auto families = registry.Collect();
    const std::lock_guard lock(mutex);
    for (const Gauge& g : gauges) {
      prometheus::MetricFamily family;
      family.name = g.name;
      family.help = g.help;
      family.type = prometheus::MetricType::Gauge;
      prometheus::ClientMetric metric;
      metric.gauge.value = g.value();
      family.metric.push_back(std::move(metric));
      families.push_back(std::move(family));
    }
    return families;
  }
};

Metrics::Metrics() : state_(std::make_shared<State>()) {
  State& s = *state_;
  auto& calls = prometheus::BuildCounter().Name("brdfd_calls_total").Help("Calls that ended, by method and status").Register(s.registry);
  auto& seconds = prometheus::BuildHistogram().Name("brdfd_call_seconds").Help("From arrival to the end of the answer").Register(s.registry);
  const prometheus::Histogram::BucketBoundaries bounds{1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 2.5e-2, 5e-2, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 60, 600};
  for (std::size_t m = 0; m < method_count; ++m) {
    for (std::size_t c = 0; c < code_names.size(); ++c) s.calls[m][c] = &calls.Add({{"method", method_names[m]}, {"code", code_names[c]}});
    s.seconds[m] = &seconds.Add({{"method", method_names[m]}}, bounds);
  }
  auto& queries = prometheus::BuildCounter().Name("brdfd_queries_total").Help("Queries answered").Register(s.registry);
  constexpr std::array operations{"evaluate", "pdf", "sample"};
  for (std::size_t i = 0; i < operations.size(); ++i) s.queries[i] = &queries.Add({{"operation", operations[i]}});
  s.refused = &prometheus::BuildCounter().Name("brdfd_refused_total").Help("Calls refused before any work, by reason").Register(s.registry);
  s.cut = &prometheus::BuildCounter().Name("brdfd_cut_connections_total").Help("Connections ended for a flood of streams").Register(s.registry).Add({});
  s.downloaded = &prometheus::BuildCounter().Name("brdfd_downloaded_bytes_total").Help("Bytes of materials sent").Register(s.registry).Add({});
  s.swapped = &prometheus::BuildCounter().Name("brdfd_material_changes_total").Help("Materials added, replaced or removed").Register(s.registry).Add({});
  s.bad_files = &prometheus::BuildCounter().Name("brdfd_bad_files_total").Help("Files that a look at the repository refused").Register(s.registry).Add({});
}

Metrics::~Metrics() = default;

void Metrics::count_call(Method method, grpc::StatusCode code, std::chrono::duration<double> took) {
  const auto m = static_cast<std::size_t>(method);
  const auto c = static_cast<std::size_t>(std::clamp(static_cast<int>(code), 0, static_cast<int>(code_names.size()) - 1));
  state_->calls[m][c]->Increment();
  state_->seconds[m]->Observe(took.count());
}

void Metrics::count_queries(std::uint64_t evaluated, std::uint64_t densities, std::uint64_t samples) {
  const std::array<std::uint64_t, 3> counts{evaluated, densities, samples};
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0) state_->queries[i]->Increment(static_cast<double>(counts[i]));
}

void Metrics::count_bytes_downloaded(std::uint64_t bytes) { state_->downloaded->Increment(static_cast<double>(bytes)); }

void Metrics::count_refused(const char* reason) { state_->refused->Add({{"reason", reason}}).Increment(); }

void Metrics::count_cut() { state_->cut->Increment(); }

void Metrics::count_poll(std::uint32_t swapped, std::size_t refused) {
  state_->swapped->Increment(swapped);
  state_->bad_files->Increment(static_cast<double>(refused));
}

void Metrics::add_gauge(const std::string& name, const std::string& help, std::function<double()> value) {
  const std::lock_guard lock(state_->mutex);
  state_->gauges.push_back({name, help, std::move(value)});
}

std::shared_ptr<prometheus::Collectable> Metrics::collectable() const { return state_; }

std::string Metrics::text() const { return prometheus::TextSerializer().Serialize(state_->Collect()); }

}  // namespace brdf::service
