// SPDX-License-Identifier: Apache-2.0
// Everything that can be set, with its default, in one table that feeds flags, environment, TOML and --print-config.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace brdf::service {

using TextList = std::vector<std::string>;

struct Settings {
  std::string repository;
  std::string repository_mode = "poll";
  double poll_interval_seconds = 5;
  std::uint64_t table_budget_bytes = std::uint64_t{512} << 20;
  std::uint64_t max_materials = 100'000;

  TextList listen;
  std::string admin_listen, metrics_listen;
  bool allow_insecure = false;
  std::string tls_certificate, tls_key, tls_client_ca;
  double tls_reload_seconds = 60;
  std::string tokens;
  bool reflection = false, channelz = false;

  std::uint64_t workers = 0;
  std::uint64_t queue_queries = 1'000'000;
  std::uint64_t max_batch_queries = 131'072;
  std::uint64_t max_message_bytes = std::uint64_t{4} << 20;
  std::uint64_t max_streams = 100;
  std::uint64_t connection_memory_bytes = std::uint64_t{256} << 20;
  std::uint64_t watchers = 1000;
  double handshake_timeout_seconds = 2;
  double keepalive_seconds = 20;
  double max_idle_seconds = 300;

  bool compress = true;
  std::string compress_program, compress_folder;
  std::uint64_t compress_jobs = 1, compress_waiting = 4, compress_threads = 1;
  std::uint64_t compress_upload_bytes = std::uint64_t{256} << 20;
  std::uint64_t compress_memory_bytes = std::uint64_t{4} << 30;
  double compress_seconds = 900;

  double drain_delay_seconds = 2, drain_timeout_seconds = 10;
  std::string log_level = "info", log_format = "text";
};

using Field = std::variant<std::string Settings::*, bool Settings::*, std::uint64_t Settings::*, double Settings::*, TextList Settings::*>;

/// `name` with dashes is the flag, with underscores the TOML key, in capitals behind BRDFD_ the variable.
struct Setting {
  std::string_view name;
  Field field;
  std::string_view help;
};

std::span<const Setting> setting_table() noexcept;
const Setting* find_setting(std::string_view name) noexcept;

/// Name of the environment's variable.
std::string variable_of(const Setting& setting);
/// Name of the flag, with its dashes.
std::string flag_of(const Setting& setting);

/// Reads a value from text; a list's parts are separated by commas. `origin` begins the sentence of Error(invalid_argument).
void assign(Settings& settings, const Setting& setting, std::string_view text, const std::string& origin);

/// The settings as a TOML file.
std::string print_settings(const Settings& settings);

/// What is wrong with them together, one sentence each; nothing on the disk or the network is looked at.
std::vector<std::string> check_settings(const Settings& settings);

}  // namespace brdf::service
