// SPDX-License-Identifier: Apache-2.0
// What Prometheus reads. Names end in their unit.
#pragma once

#include <grpcpp/support/status.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace prometheus {
class Collectable;
}

namespace brdf::service {

/// Calls that are counted.
enum class Method : std::uint8_t {
  list_materials, get_material, download_material, evaluate, evaluate_stream, albedo, find_similar, compress, watch_materials, load_material, unload_material, reload_repository,
};
inline constexpr std::size_t method_count = 12;
const char* to_string(Method method) noexcept;

/// Thread-safe.
class Metrics {
 public:
  Metrics();
  ~Metrics();

  void count_call(Method method, grpc::StatusCode code, std::chrono::duration<double> took);
  void count_queries(std::uint64_t evaluated, std::uint64_t densities, std::uint64_t samples);
  void count_bytes_downloaded(std::uint64_t bytes);
  void count_refused(const char* reason);  ///< "queue", "token", "compress"
  void count_cut();                        ///< a connection that was ended for what it did
  void count_poll(std::uint32_t swapped, std::size_t refused);

  /// A figure that is asked for when somebody looks.
  void add_gauge(const std::string& name, const std::string& help, std::function<double()> value);

  /// For an exposer; and as text, for tests.
  std::shared_ptr<prometheus::Collectable> collectable() const;
  std::string text() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace brdf::service
