// SPDX-License-Identifier: Apache-2.0
#include "run/health_check.h"

#include "base/file_io.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "shared/silence_grpc.h"

#include <grpcpp/create_channel.h>

#include <cstdio>

namespace brdf::service {
namespace {

std::string read_text(const std::string& file) {
  if (file.empty()) return {};
  const auto bytes = base::read_file(file, std::uint64_t{1} << 20);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

int check_health(const HealthQuestion& q, std::chrono::milliseconds deadline) {
  silence_grpc();
  const auto credentials = q.ca.empty() ? grpc::InsecureChannelCredentials() : grpc::SslCredentials({read_text(q.ca), read_text(q.key), read_text(q.certificate)});
  const auto stub = grpc::health::v1::Health::NewStub(grpc::CreateChannel(q.address, credentials));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + deadline);
  grpc::health::v1::HealthCheckResponse response;
  const grpc::Status status = stub->Check(&context, {}, &response);
  if (!status.ok()) {
    std::fprintf(stderr, "brdfd: %s: %s\n", q.address.c_str(), status.error_message().c_str());
    return 1;
  }
  const std::string name = grpc::health::v1::HealthCheckResponse::ServingStatus_Name(response.status());
  std::printf("%s\n", name.c_str());
  return response.status() == grpc::health::v1::HealthCheckResponse::SERVING ? 0 : 1;
}

}  // namespace brdf::service
