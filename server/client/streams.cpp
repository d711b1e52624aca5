// SPDX-License-Identifier: Apache-2.0
#include "client/client_state.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <thread>

namespace brdf::client {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 18;

}  // namespace

void Client::evaluate_stream(const std::function<bool(v1::EvaluateRequest&)>& next, const std::function<void(std::uint64_t, const v1::EvaluateResponse&)>& answer,
                             std::chrono::milliseconds deadline) {
  grpc::ClientContext context;
  state_->prepare(context, deadline);
  v1::BrdfService::Stub stub(state_->replicas.any());
  const auto stream = stub.EvaluateStream(&context);
  std::exception_ptr failed;
  // The server stops reading when its answers are not read, so both directions move at once.
  std::thread writer([&] {
    try {
      v1::EvaluateStreamRequest request;
      for (std::uint64_t id = 0; next(*request.mutable_request()); ++id) {
        request.set_id(id);
        if (!stream->Write(request)) break;
        request.Clear();
      }
    } catch (...) {
      failed = std::current_exception();
      context.TryCancel();
    }
    stream->WritesDone();
  });
  v1::EvaluateStreamResponse response;
  try {
    while (stream->Read(&response)) answer(response.id(), response.response());
  } catch (...) {
    context.TryCancel();
    writer.join();
    stream->Finish();
    throw;
  }
  writer.join();
  const grpc::Status status = stream->Finish();
  if (failed) std::rethrow_exception(failed);
  if (!status.ok()) State::fail(status, context);
}

v1::Material Client::compress(const v1::CompressOptions& options, std::span<const std::byte> file, const std::function<bool(const std::string&, double)>& progress,
                              std::chrono::milliseconds deadline) {
  grpc::ClientContext context;
  state_->prepare(context, deadline);
  v1::BrdfService::Stub stub(state_->replicas.any());
  const auto stream = stub.Compress(&context);
  std::thread writer([&] {
    v1::CompressRequest request;
    *request.mutable_options() = options;
    bool open = stream->Write(request);
    for (std::span<const std::byte> rest = file; open && !rest.empty();) {
      const auto part = rest.first(std::min(rest.size(), chunk_bytes));
      request.set_chunk(part.data(), part.size());
      open = stream->Write(request);
      rest = rest.subspan(part.size());
    }
    stream->WritesDone();
  });
  v1::CompressResponse response;
  v1::Material material;
  while (stream->Read(&response)) {
    if (response.has_material()) material = response.material();
    if (response.has_progress() && progress && !progress(response.progress().stage(), response.progress().done())) context.TryCancel();
  }
  writer.join();
  const grpc::Status status = stream->Finish();
  if (!status.ok()) State::fail(status, context);
  return material;
}

}  // namespace brdf::client
