// SPDX-License-Identifier: Apache-2.0
#include "config/listen_address.h"
#include "config/settings.h"

#include <brdf/error.h>

#include <algorithm>
#include <initializer_list>

namespace brdf::service {
namespace {

class Findings {
 public:
  void require(bool holds, const std::string& sentence) {
    if (!holds) list_.push_back(sentence);
  }

  void one_of(const char* name, const std::string& value, std::initializer_list<const char*> allowed) {
    std::string names;
    for (const char* word : allowed) names += (names.empty() ? "" : ", ") + std::string(word);
    require(std::find(allowed.begin(), allowed.end(), value) != allowed.end(), std::string(name) + " is '" + value + "', allowed are " + names);
  }

  void address(const char* name, const std::string& text, const Settings& s, bool may_be_unix = true) {
    try {
      const ListenAddress address = parse_listen_address(text);
      require(may_be_unix || !address.is_unix(), std::string(name) + " is '" + text + "', wanted is HOST:PORT");
      const bool tls = !s.tls_certificate.empty() && may_be_unix;  // the metrics' server has none
      require(address.stays_here() || tls || s.allow_insecure,
              std::string(name) + " is '" + text + "', which other machines reach, and there is no TLS: set tls_certificate and tls_key, or allow_insecure");
    } catch (const Error& e) {
      list_.push_back(std::string(name) + ": " + e.what());
    }
  }

  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

}  // namespace

std::vector<std::string> check_settings(const Settings& s) {
  Findings f;
  f.require(!s.repository.empty(), "repository is not set");
  f.require(!s.listen.empty(), "listen is not set");
  f.one_of("repository_mode", s.repository_mode, {"none", "poll", "explicit"});
  f.one_of("log_level", s.log_level, {"debug", "info", "warning", "error"});
  f.one_of("log_format", s.log_format, {"text", "json"});
  for (const std::string& text : s.listen) f.address("listen", text, s);
  if (!s.admin_listen.empty()) f.address("admin_listen", s.admin_listen, s);
  if (!s.metrics_listen.empty()) f.address("metrics_listen", s.metrics_listen, s, false);
  f.require(s.tls_certificate.empty() == s.tls_key.empty(), "tls_certificate and tls_key go together: one of them is not set");
  f.require(s.tls_client_ca.empty() || !s.tls_certificate.empty(), "tls_client_ca needs tls_certificate");
  f.require(s.poll_interval_seconds >= 0.01 && s.poll_interval_seconds <= 86400, "poll_interval_seconds must be 0.01 to 86400");
  f.require(s.tls_reload_seconds >= 1 && s.tls_reload_seconds <= 86400, "tls_reload_seconds must be 1 to 86400");
  f.require(s.handshake_timeout_seconds >= 0.1 && s.handshake_timeout_seconds <= 600, "handshake_timeout_seconds must be 0.1 to 600");
  f.require(s.keepalive_seconds >= 1 && s.keepalive_seconds <= 86400, "keepalive_seconds must be 1 to 86400");
  f.require(s.max_idle_seconds >= 1 && s.max_idle_seconds <= 864000, "max_idle_seconds must be 1 to 864000");
  f.require(s.drain_delay_seconds <= 600 && s.drain_timeout_seconds <= 3600, "drain_delay_seconds must be at most 600, drain_timeout_seconds at most 3600");
  f.require(s.workers <= 1024, "workers must be at most 1024");
  f.require(s.max_batch_queries >= 1 && s.max_batch_queries <= (1U << 24), "max_batch_queries must be 1 to 16777216");
  f.require(s.queue_queries >= s.max_batch_queries, "queue_queries must be at least max_batch_queries, or a large message would always be refused");
  f.require(s.max_message_bytes >= 65536 && s.max_message_bytes <= (std::uint64_t{1} << 30), "max_message_bytes must be 65536 to 1073741824");
  f.require(s.max_streams >= 1 && s.max_streams <= 1'000'000, "max_streams must be 1 to 1000000");
  f.require(s.connection_memory_bytes >= s.max_message_bytes, "connection_memory_bytes must be at least max_message_bytes");
  f.require(s.compress_jobs >= 1 && s.compress_jobs <= 256, "compress_jobs must be 1 to 256");
  f.require(s.compress_threads >= 1 && s.compress_threads <= 1024, "compress_threads must be 1 to 1024");
  f.require(s.compress_seconds >= 1 && s.compress_seconds <= 86400, "compress_seconds must be 1 to 86400");
  f.require(s.compress_memory_bytes == 0 || s.compress_memory_bytes >= (std::uint64_t{256} << 20), "compress_memory_bytes must be 0, for no limit, or at least 268435456");
  return f.take();
}

}  // namespace brdf::service
