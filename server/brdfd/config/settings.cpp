// SPDX-License-Identifier: Apache-2.0
#include "config/settings.h"

#include "config/quoted.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace brdf::service {
namespace {

constexpr std::array table{
    Setting{"repository", &Settings::repository, "Folder of .brdfc files"},
    Setting{"repository_mode", &Settings::repository_mode,
            "none: as it was at the start; poll: looked at again and again; explicit: as the admin service says"},
    Setting{"poll_interval_seconds", &Settings::poll_interval_seconds, "Between two looks at the folder (mode poll)"},
    Setting{"table_budget_bytes", &Settings::table_budget_bytes, "Tables of decoded materials kept; the least recently used go first"},
    Setting{"max_materials", &Settings::max_materials, "Files beyond this many are refused"},
    Setting{"listen", &Settings::listen, "unix:PATH or HOST:PORT, several with commas; port 0: any"},
    Setting{"admin_listen", &Settings::admin_listen, "Where the admin service listens; empty: nowhere"},
    Setting{"metrics_listen", &Settings::metrics_listen, "HOST:PORT of Prometheus metrics (/metrics); empty: nowhere"},
    Setting{"allow_insecure", &Settings::allow_insecure, "Listen beyond this machine without TLS"},
    Setting{"tls_certificate", &Settings::tls_certificate, "PEM chain; TLS on every listener that is no unix socket"},
    Setting{"tls_key", &Settings::tls_key, "PEM key of tls_certificate"},
    Setting{"tls_client_ca", &Settings::tls_client_ca, "PEM roots; clients must show a certificate that they signed"},
    Setting{"tls_reload_seconds", &Settings::tls_reload_seconds, "Between two looks at the PEM files"},
    Setting{"tokens", &Settings::tokens, "File of 'ROLE TOKEN' lines; every call then needs one (roles read, compress, admin)"},
    Setting{"reflection", &Settings::reflection, "Serve gRPC reflection"},
    Setting{"channelz", &Settings::channelz, "Serve channelz on the admin listener"},
    Setting{"workers", &Settings::workers, "Threads that evaluate; 0: one a processor"},
    Setting{"queue_queries", &Settings::queue_queries, "Queries that may wait; more are answered RESOURCE_EXHAUSTED"},
    Setting{"max_batch_queries", &Settings::max_batch_queries, "Queries of one message"},
    Setting{"max_message_bytes", &Settings::max_message_bytes, "Size of one message"},
    Setting{"max_streams", &Settings::max_streams, "Calls at once on one connection"},
    Setting{"connection_memory_bytes", &Settings::connection_memory_bytes, "What gRPC may hold for connections and messages"},
    Setting{"watchers", &Settings::watchers, "WatchMaterials calls at once"},
    Setting{"handshake_timeout_seconds", &Settings::handshake_timeout_seconds, "A connection that says nothing is closed"},
    Setting{"keepalive_seconds", &Settings::keepalive_seconds, "A peer that does not answer a ping for so long is gone"},
    Setting{"max_idle_seconds", &Settings::max_idle_seconds, "A connection without calls is closed"},
    Setting{"compress", &Settings::compress, "Serve Compress"},
    Setting{"compress_program", &Settings::compress_program, "brdf-compress; empty: the one beside brdfd, or in PATH"},
    Setting{"compress_folder", &Settings::compress_folder, "Where uploads wait; empty: the system's folder for temporary files"},
    Setting{"compress_jobs", &Settings::compress_jobs, "Compressions at once"},
    Setting{"compress_waiting", &Settings::compress_waiting, "Compressions that may wait"},
    Setting{"compress_threads", &Settings::compress_threads, "Threads of one compression"},
    Setting{"compress_upload_bytes", &Settings::compress_upload_bytes, "Size of an uploaded file"},
    Setting{"compress_memory_bytes", &Settings::compress_memory_bytes, "Address space of a compression; 0: no limit"},
    Setting{"compress_seconds", &Settings::compress_seconds, "Time of a compression"},
    Setting{"drain_delay_seconds", &Settings::drain_delay_seconds, "Between saying NOT_SERVING and refusing calls"},
    Setting{"drain_timeout_seconds", &Settings::drain_timeout_seconds, "For calls in flight at the end"},
    Setting{"log_level", &Settings::log_level, "debug, info, warning or error"},
    Setting{"log_format", &Settings::log_format, "text or json, a line an event on stderr"},
};

template <class... Calls>
struct Choice : Calls... {
  using Calls::operator()...;
};
template <class... Calls>
Choice(Calls...) -> Choice<Calls...>;  // clang 14 does not deduce it

template <class Number>
Number parse_number(std::string_view text, const std::string& origin, const char* wanted) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw Error(ErrorCode::invalid_argument, origin + " is '" + std::string(text) + "', wanted is " + wanted);
  }
  return value;
}

bool parse_switch(std::string_view text, const std::string& origin) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw Error(ErrorCode::invalid_argument, origin + " is '" + std::string(text) + "', wanted is true or false");
}

TextList parse_list(std::string_view text) {
  TextList list;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    if (comma != 0) list.emplace_back(text.substr(0, comma));
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
  }
  return list;
}

}  // namespace

std::span<const Setting> setting_table() noexcept { return table; }

const Setting* find_setting(std::string_view name) noexcept {
  const auto found = std::find_if(table.begin(), table.end(), [name](const Setting& s) { return s.name == name; });
  return found == table.end() ? nullptr : &*found;
}

std::string variable_of(const Setting& setting) {
  std::string name = "BRDFD_";
  for (const char c : setting.name) name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string flag_of(const Setting& setting) {
  std::string name = "--" + std::string(setting.name);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

void assign(Settings& settings, const Setting& setting, std::string_view text, const std::string& origin) {
  std::visit(Choice{[&](std::string Settings::*m) { settings.*m = text; },
                    [&](bool Settings::*m) { settings.*m = parse_switch(text, origin); },
                    [&](std::uint64_t Settings::*m) { settings.*m = parse_number<std::uint64_t>(text, origin, "a whole number of at least 0"); },
                    [&](double Settings::*m) {
                      const double value = parse_number<double>(text, origin, "a number");
                      if (!std::isfinite(value) || value < 0) throw Error(ErrorCode::invalid_argument, origin + " is '" + std::string(text) + "', wanted is a number of at least 0");
                      settings.*m = value;
                    },
                    [&](TextList Settings::*m) { settings.*m = parse_list(text); }},
             setting.field);
}

std::string print_settings(const Settings& settings) {
  std::string out;
  for (const Setting& s : table) {
    std::string value;
    std::visit(Choice{[&](std::string Settings::*m) { value = quoted(settings.*m); },
                      [&](bool Settings::*m) { value = settings.*m ? "true" : "false"; },
                      [&](std::uint64_t Settings::*m) { value = std::to_string(settings.*m); },
                      [&](double Settings::*m) {
                        std::array<char, 32> digits;
                        value.assign(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), settings.*m).ptr);
                        if (value.find_first_of(".e") == std::string::npos) value += ".0";
                      },
                      [&](TextList Settings::*m) {
                        for (const std::string& part : settings.*m) value += (value.empty() ? "" : ", ") + quoted(part);
                        value = "[" + value + "]";
                      }},
               s.field);
    ((((out += "# ") += s.help) += '\n') += s.name) += " = " + value + "\n";
  }
  return out;
}

}  // namespace brdf::service
