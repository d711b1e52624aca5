// SPDX-License-Identifier: Apache-2.0
#include "rpc/serving.h"

namespace brdf::service {
namespace {

std::optional<CompressSetup> compress_setup(const Settings& s) {
  if (!s.compress) return std::nullopt;
  CompressSetup setup;
  setup.program = s.compress_program.empty() ? find_compress_program() : std::filesystem::path(s.compress_program);
  if (setup.program.empty()) return std::nullopt;
  setup.folder = s.compress_folder.empty() ? std::filesystem::temp_directory_path() : std::filesystem::path(s.compress_folder);
  setup.upload_bytes = s.compress_upload_bytes;
  setup.threads = s.compress_threads;
  setup.limits.memory_bytes = s.compress_memory_bytes;
  setup.limits.file_bytes = DecodeLimits{}.max_file_bytes;
  setup.limits.time = std::chrono::milliseconds(static_cast<std::int64_t>(s.compress_seconds * 1000));
  return setup;
}

}  // namespace

std::shared_ptr<const SimilarMaterials::Indexed> SimilarMaterials::get(const CatalogueHandle& catalogue) {
  const std::lock_guard lock(mutex_);
  if (!last_ || last_->catalogue != catalogue) {
    std::vector<Descriptor> descriptors;
    for (const VersionHandle& m : catalogue->materials()) descriptors.push_back(m->descriptor);
    last_.reset(new Indexed{catalogue, SimilarIndex(std::move(descriptors))});
  }
  return last_;
}

Serving::Serving(const Settings& s)
    : settings(s),
      limits{s.max_batch_queries, s.max_message_bytes},
      repository(s.repository, repository_mode(s.repository_mode), {s.max_materials, {}}),
      tables(s.table_budget_bytes),
      compress(compress_setup(s)),
      workers(static_cast<std::size_t>(s.workers), s.queue_queries),
      uploads(1, 4 * s.max_message_bytes),
      compressions(static_cast<std::size_t>(s.compress_jobs), s.compress_jobs + s.compress_waiting) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  metrics.add_gauge("brdfd_queue_queries", "Queries that wait or run", [this, number] { return number(workers.load()); });
  metrics.add_gauge("brdfd_queue_capacity_queries", "Queries that may wait", [this, number] { return number(workers.capacity()); });
  metrics.add_gauge("brdfd_materials", "Materials served", [this, number] { return number(repository.catalogue()->materials().size()); });
  metrics.add_gauge("brdfd_table_bytes", "Tables of decoded materials that are kept", [this, number] { return number(tables.bytes()); });
  metrics.add_gauge("brdfd_tables_built", "Tables built since the start", [this, number] { return number(tables.built()); });
  metrics.add_gauge("brdfd_tables_dropped", "Tables dropped for others since the start", [this, number] { return number(tables.dropped()); });
  metrics.add_gauge("brdfd_compressions", "Compressions that wait or run", [this, number] { return number(compressions.load()); });
}

}  // namespace brdf::service
