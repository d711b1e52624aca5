// SPDX-License-Identifier: Apache-2.0
#include "run/foreign_logs.h"

#include "config/log.h"

#include <google/protobuf/stubs/logging.h>
#include <grpc/support/log.h>

namespace brdf::service {

void route_foreign_logs() noexcept {
  gpr_set_log_function([](gpr_log_func_args* args) {
    log_event(args->severity == GPR_LOG_SEVERITY_ERROR ? Severity::warning : Severity::debug, "grpc", {{"message", args->message}});
  });
  google::protobuf::SetLogHandler([](google::protobuf::LogLevel, const char*, int, const std::string& message) { log_event(Severity::debug, "protobuf", {{"message", message}}); });
}

}  // namespace brdf::service
