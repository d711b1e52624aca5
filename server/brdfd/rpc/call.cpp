// SPDX-License-Identifier: Apache-2.0
#include "rpc/call.h"

#include "config/log.h"
#include "query/field_error.h"
#include "shared/error_table.h"
#include "shared/excerpt.h"
#include "shared/material_name.h"

#include <algorithm>
#include <cctype>
#include <new>

namespace brdf::service {
namespace {

constexpr std::string_view bearer = "Bearer ";
constexpr std::size_t longest_token = 4096;

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace

void Call::require(Role role) const {
  const auto tokens = serving_.access.get();
  if (!tokens) return;
  const auto& metadata = context_->client_metadata();
  const auto [first, last] = metadata.equal_range("authorization");
  std::optional<Role> given;
  if (first != last && std::next(first) == last) {  // two are one too many to choose from
    const std::string_view value(first->second.data(), first->second.size());
    if (value.starts_with(bearer) && value.size() <= longest_token) given = tokens->role_of(value.substr(bearer.size()));
  }
  if (!given) {
    serving_.metrics.count_refused("token");
    throw StatusError(grpc::StatusCode::UNAUTHENTICATED, "TOKEN_UNKNOWN", "this server wants 'authorization: Bearer TOKEN' with a token that it knows");
  }
  if (*given < role) {
    serving_.metrics.count_refused("token");
    throw StatusError(grpc::StatusCode::PERMISSION_DENIED, "ROLE_MISSING", std::string("this call needs the role ") + to_string(role) + ", the token has " + to_string(*given));
  }
}

void Call::overloaded(const char* reason, const std::string& sentence, std::chrono::milliseconds retry) const {
  serving_.metrics.count_refused(reason);
  context_->AddTrailingMetadata("grpc-retry-pushback-ms", std::to_string(retry.count()));
  throw StatusError(grpc::StatusCode::RESOURCE_EXHAUSTED, {upper(reason) + "_FULL", {}, retry}, sentence);
}

bool Call::is_over() const { return context_->IsCancelled() || context_->deadline() <= std::chrono::system_clock::now(); }

grpc::Status Call::over() const {
  if (context_->deadline() <= std::chrono::system_clock::now()) return {grpc::StatusCode::DEADLINE_EXCEEDED, "the deadline came before the answer"};
  return {grpc::StatusCode::CANCELLED, "the call was cancelled"};
}

grpc::Status Call::status_of_exception() const {
  try {
    throw;
  } catch (const StatusError& e) {
    return detailed_status(e.code(), e.what(), e.details());
  } catch (const Error& e) {
    context_->AddTrailingMetadata(error_metadata_key, to_string(e.code()));
    const auto* field = dynamic_cast<const FieldError*>(&e);
    return detailed_status(status_of(e.code()), e.what(), {upper(to_string(e.code())), field == nullptr ? "" : field->field(), {}});
  } catch (const std::bad_alloc&) {
    return detailed_status(grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is out of memory", {"OUT_OF_MEMORY", {}, {}});
  } catch (const std::exception& e) {
    log_event(Severity::error, "call.failed", {{"method", to_string(method_)}, {"reason", e.what()}});
    return detailed_status(grpc::StatusCode::INTERNAL, "the server failed", {"INTERNAL", {}, {}});
  }
}

void Call::count(const grpc::Status& status) const {
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
  serving_.metrics.count_call(method_, status.error_code(), took);
  if (!status.ok()) {
    log_event(Severity::debug, "call.refused", {{"method", to_string(method_)}, {"status", std::to_string(status.error_code())}, {"reason", status.error_message()}});
  }
}

bool is_cut_short(const google::protobuf::MessageLite& message) { return message.ByteSizeLong() != 0; }

grpc::Status unreadable_message() { return detailed_status(grpc::StatusCode::INVALID_ARGUMENT, "a message is no protobuf of its type, or a text in it is not UTF-8", {"MESSAGE_UNREADABLE", {}, {}}); }

VersionHandle find_version(const Catalogue& catalogue, const char* field, const std::string& name) {
  const auto parsed = parse_material_name(name);
  if (!parsed) throw FieldError(field, "is " + excerpt(name) + ", which is no name of a material, wanted is materials/{material} or materials/{material}/versions/{version}");
  VersionHandle found = catalogue.find(parsed->id);
  if (!found) throw StatusError(grpc::StatusCode::NOT_FOUND, "MATERIAL_NOT_FOUND", "there is no material " + excerpt(name));
  if (!parsed->version.empty() && found->version != parsed->version) {
    throw StatusError(grpc::StatusCode::NOT_FOUND, "VERSION_NOT_FOUND", material_name(parsed->id) + " is served as version " + found->version + ", not as " + parsed->version);
  }
  return found;
}

}  // namespace brdf::service
