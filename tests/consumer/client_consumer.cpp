// SPDX-License-Identifier: Apache-2.0
// Asks a running brdfd through the installed headers and brdf::client: one material fetched and evaluated here, and evaluated there.
// usage: client_consumer ADDRESS MATERIAL

#include <brdf/client/client.h>

#include <array>
#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  brdf::client::ClientOptions options;
  options.servers = {argv[1]};
  brdf::client::Client client(options);
  try {
    client.get("materials/no-such-material");
    std::printf("FAILED: a material that is not there was found\n");
    return 1;
  } catch (const brdf::client::CallError& e) {
    if (e.code() != grpc::StatusCode::NOT_FOUND) {
      std::printf("FAILED: %s\n", e.what());
      return 1;
    }
  }
  const std::string name = std::string("materials/") + argv[2];
  const std::array<float, 3> wi{0, 0, 1}, wo{0.6F, 0, 0.8F};
  const brdf::Material here = client.open(name);
  std::array<float, 64> f{};
  here.eval({wi[0], wi[1], wi[2]}, {wo[0], wo[1], wo[2]}, f);

  brdf::v1::EvaluateRequest request;
  request.set_material(name);
  request.set_operations(brdf::v1::OPERATION_EVALUATE);
  request.set_count(1);
  request.set_wi(wi.data(), sizeof(wi));
  request.set_wo(wo.data(), sizeof(wo));
  const brdf::v1::EvaluateResponse there = client.evaluate(request);
  const std::size_t bytes = static_cast<std::size_t>(here.channels()) * sizeof(float);
  const bool same = there.values().size() == bytes && std::memcmp(there.values().data(), f.data(), bytes) == 0;
  std::printf("%s: f = %.6g here, %s there\n", there.version().c_str(), static_cast<double>(f[0]), same ? "the same" : "ANOTHER");
  return same && f[0] > 0 ? 0 : 1;
}
