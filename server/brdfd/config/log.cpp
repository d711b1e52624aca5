// SPDX-License-Identifier: Apache-2.0
#include "config/log.h"

#include "config/quoted.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>

namespace brdf::service {
namespace {

std::atomic<bool> as_json{false};

spdlog::level::level_enum level_of(Severity s) noexcept {
  switch (s) {
    case Severity::debug: return spdlog::level::debug;
    case Severity::info: return spdlog::level::info;
    case Severity::warning: return spdlog::level::warn;
    case Severity::error: return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

std::string format_event(bool json, std::string_view event, std::initializer_list<LogField> fields) {
  std::string out;
  if (json) {
    out = quoted(event);
  } else {
    out = event;
  }
  for (const auto& [name, value] : fields) {
    if (json) {
      (out += ", \"") += name;
      out += "\": ";
    } else {
      (out += ' ') += name;
      out += '=';
    }
    out += quoted(value);
  }
  return out;
}

void start_log(std::string_view level, std::string_view format) {
  as_json = format == "json";
  auto logger = std::make_shared<spdlog::logger>("brdfd", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  logger->set_pattern(as_json ? R"({"time": "%Y-%m-%dT%H:%M:%S.%eZ", "level": "%l", "event": %v})" : "%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  logger->set_level(level == "debug" ? spdlog::level::debug : level == "warning" ? spdlog::level::warn : level == "error" ? spdlog::level::err : spdlog::level::info);
  logger->flush_on(spdlog::level::debug);
  logger->set_error_handler([](const std::string&) {});  // a log that nobody reads must not end the service
  spdlog::set_default_logger(std::move(logger));
}

void log_event(Severity severity, std::string_view event, std::initializer_list<LogField> fields) noexcept {
  try {
    const auto level = level_of(severity);
    if (spdlog::default_logger_raw()->should_log(level)) spdlog::default_logger_raw()->log(level, spdlog::string_view_t(format_event(as_json, event, fields)));
  } catch (...) {  // the message is lost, the call that it tells of is not
  }
}

}  // namespace brdf::service
