// SPDX-License-Identifier: Apache-2.0
#include "server/load/echo_service.h"

#include "brdf/v1/brdf_service.grpc.pb.h"

#include <grpcpp/server_builder.h>

#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <cstdio>

namespace brdf::load {
namespace {

class Echo : public v1::BrdfService::CallbackService {
 public:
  grpc::ServerUnaryReactor* Evaluate(grpc::CallbackServerContext* context, const v1::EvaluateRequest* request, v1::EvaluateResponse* response) override {
    response->set_version(request->material());
    response->set_count(request->count());
    response->set_channels(3);
    response->set_values(request->wi());
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(grpc::Status::OK);
    return reactor;
  }
};

}  // namespace

int serve_echo(const std::string& address) {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  Echo echo;
  grpc::ServerBuilder builder;
  builder.AddListeningPort(address, grpc::InsecureServerCredentials());
  builder.RegisterService(&echo);
  const auto server = builder.BuildAndStart();
  if (!server) return 1;
  std::printf("echo ready\n");
  std::fflush(stdout);
  int number = 0;
  while (::sigwait(&signals, &number) != 0) {
  }
  server->Shutdown(std::chrono::system_clock::now());
  return 0;
}

}  // namespace brdf::load
