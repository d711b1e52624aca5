// SPDX-License-Identifier: Apache-2.0
// What the calls of a client share.
#pragma once

#include "brdf/v1/brdf_service.grpc.pb.h"
#include "client/file_cache.h"
#include "client/replicas.h"
#include "shared/error_table.h"
#include "shared/material_name.h"

#include <brdf/client/client.h>

#include <grpcpp/client_context.h>

#include <string>
#include <utility>

namespace brdf::client {

struct Client::State {
  explicit State(ClientOptions o) : options(std::move(o)), replicas(options), cache(options.cache, options.cache_bytes) {}

  using Time = std::chrono::system_clock::time_point;

  /// Of a call that begins now, however many attempts it takes.
  Time deadline() const { return std::chrono::system_clock::now() + options.deadline; }

  void prepare(grpc::ClientContext& context, std::chrono::milliseconds left) const { prepare(context, std::chrono::system_clock::now() + left); }
  void prepare(grpc::ClientContext& context, Time deadline) const {
    context.set_deadline(deadline);
    if (!options.token.empty()) context.AddMetadata("authorization", "Bearer " + options.token);
  }

  [[noreturn]] static void fail(const grpc::Status& status, const grpc::ClientContext& context) {
    std::string library_code;
    const auto& trailers = context.GetServerTrailingMetadata();
    if (const auto found = trailers.find(service::error_metadata_key); found != trailers.end()) library_code.assign(found->second.data(), found->second.size());
    throw CallError(status.error_code(), status.error_message(), library_code);
  }

  /// A call of one answer: on the servers of a material one after the other, while they cannot be reached.
  template <class Request, class Response>
  Response call(const std::string& name, const Request& request, grpc::Status (v1::BrdfService::Stub::*method)(grpc::ClientContext*, const Request&, Response*)) const {
    const auto parsed = service::parse_material_name(name);
    const auto channels = replicas.channels_for(parsed ? parsed->id : name);
    const Time until = deadline();
    for (std::size_t i = 0;; ++i) {
      grpc::ClientContext context;
      prepare(context, until);
      v1::BrdfService::Stub stub(channels[i]);
      Response response;
      const grpc::Status status = (stub.*method)(&context, request, &response);
      if (status.ok()) return response;
      if (status.error_code() != grpc::StatusCode::UNAVAILABLE || i + 1 == channels.size()) fail(status, context);
    }
  }

  ClientOptions options;
  Replicas replicas;
  FileCache cache;
};

}  // namespace brdf::client
