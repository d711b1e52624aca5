// SPDX-License-Identifier: Apache-2.0
// Structured events on stderr, as text or as JSON, a line each.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace brdf::service {

enum class Severity { debug, info, warning, error };

/// Once, at the start. `level` and `format` are settings that were checked.
void start_log(std::string_view level, std::string_view format);

using LogField = std::pair<std::string_view, std::string>;

/// An event's name, and what belongs to it. Thread-safe; never throws. Tokens and contents of files have no business here.
void log_event(Severity severity, std::string_view event, std::initializer_list<LogField> fields = {}) noexcept;

/// As it is written; for tests.
std::string format_event(bool json, std::string_view event, std::initializer_list<LogField> fields);

}  // namespace brdf::service
