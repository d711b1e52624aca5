// SPDX-License-Identifier: Apache-2.0
#include <brdf/client/client.h>

#include "client/client_state.h"
#include "grpc/health/v1/health.grpc.pb.h"

namespace brdf::client {

Client::Client(ClientOptions options) : state_(std::make_unique<State>(std::move(options))) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;

v1::ListMaterialsResponse Client::list(const v1::ListMaterialsRequest& request) { return state_->call("", request, &v1::BrdfService::Stub::ListMaterials); }

v1::Material Client::get(const std::string& name) {
  v1::GetMaterialRequest request;
  request.set_name(name);
  return state_->call(name, request, &v1::BrdfService::Stub::GetMaterial).material();
}

v1::EvaluateResponse Client::evaluate(const v1::EvaluateRequest& request) { return state_->call(request.material(), request, &v1::BrdfService::Stub::Evaluate); }

v1::AlbedoResponse Client::albedo(const v1::AlbedoRequest& request) { return state_->call(request.material(), request, &v1::BrdfService::Stub::Albedo); }

v1::FindSimilarResponse Client::similar(const v1::FindSimilarRequest& request) { return state_->call(request.material(), request, &v1::BrdfService::Stub::FindSimilar); }

Material Client::open(const std::string& name, DecodeOptions decode, const FetchOptions& options) {
  const Fetched fetched = fetch(name, options);
  decode.allow_prefix = decode.allow_prefix || fetched.bytes.size() < fetched.file_bytes;
  return Material::decode(fetched.bytes, decode);
}

bool Client::healthy() {
  grpc::ClientContext context;
  state_->prepare(context, state_->options.deadline);
  grpc::health::v1::Health::Stub stub(state_->replicas.any());
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(v1::BrdfService::service_full_name());
  grpc::health::v1::HealthCheckResponse response;
  const grpc::Status status = stub.Check(&context, request, &response);
  if (!status.ok()) State::fail(status, context);
  return response.status() == grpc::health::v1::HealthCheckResponse::SERVING;
}

}  // namespace brdf::client
