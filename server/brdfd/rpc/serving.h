// SPDX-License-Identifier: Apache-2.0
// What every call may use. One for the life of the daemon.
#pragma once

#include "compress/compress_job.h"
#include "config/settings.h"
#include "config/tokens.h"
#include "query/batch.h"
#include "query/similar_index.h"
#include "query/worker_pool.h"
#include "repository/repository.h"
#include "repository/table_cache.h"
#include "rpc/metrics.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

namespace brdf::service {

/// Tokens that can be read again while calls come in. No tokens: everybody may do everything that the listener serves.
class Access {
 public:
  void set(std::shared_ptr<const Tokens> tokens) {
    const std::lock_guard lock(mutex_);
    tokens_.swap(tokens);
  }
  std::shared_ptr<const Tokens> get() const {
    const std::lock_guard lock(mutex_);
    return tokens_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const Tokens> tokens_;
};

/// The index of the present catalogue, built when somebody asks and kept until the catalogue changes.
class SimilarMaterials {
 public:
  struct Indexed {
    CatalogueHandle catalogue;
    SimilarIndex index;
  };
  std::shared_ptr<const Indexed> get(const CatalogueHandle& catalogue);

 private:
  std::mutex mutex_;
  std::shared_ptr<const Indexed> last_;
};

struct Serving {
  explicit Serving(const Settings& s);

  const Settings settings;
  const BatchLimits limits;
  Metrics metrics;
  Access access;
  Repository repository;
  TableCache tables;
  SimilarMaterials similar;
  std::optional<CompressSetup> compress;  ///< nothing: not served
  std::atomic<std::uint64_t> compress_calls{0};  ///< that upload, wait or run
  std::atomic<bool> ending{false};        ///< calls without end are to end
  // Threads last: they end before what they use goes.
  WorkerPool workers;
  WorkerPool uploads;       ///< one thread that writes uploads; bounded in bytes
  WorkerPool compressions;  ///< bounded in jobs
};

}  // namespace brdf::service
