// SPDX-License-Identifier: Apache-2.0
#include "server/load/hostile_clients.h"

#include "server/load/http2_frames.h"
#include "server/load/latency.h"
#include "server/load/raw_socket.h"

#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/impl/codegen/client_unary_call.h>

#include <sched.h>

#include <cstring>
#include <limits>
#include <random>
#include <thread>

namespace brdf::load {
namespace {

using namespace std::chrono_literals;

RawSocket connect(const Served& served, std::size_t i) { return RawSocket(i % 2 == 0 ? served.tcp_address : served.address); }

constexpr std::string_view evaluate_path = "/brdf.v1.BrdfService/Evaluate";

std::string opening() { return std::string(http2::preface) + http2::frame(http2::FrameType::settings, 0, 0, ""); }

}  // namespace

void use_idle_time() noexcept {
  sched_param none{};
  ::sched_setscheduler(0, SCHED_IDLE, &none);
}

void Hostile::stay_silent(const std::atomic<bool>& end, std::size_t count) const {
  while (!end) {
    std::vector<RawSocket> sockets;
    for (std::size_t i = 0; i < count && !end; ++i) {
      sockets.push_back(connect(served, i));
      counts.silent += static_cast<std::uint64_t>(sockets.back().open());
      std::this_thread::sleep_for(2ms);  // a crowd, not a flood: the load itself shares these processors
    }
    for (int i = 0; i < 35 && !end; ++i) std::this_thread::sleep_for(100ms);
    while (!sockets.empty()) {
      counts.closed += static_cast<std::uint64_t>(!sockets.back().drain());
      sockets.pop_back();
      if (!end) std::this_thread::sleep_for(1ms);
    }
  }
}

void Hostile::stay_half_open(const std::atomic<bool>& end, std::size_t count) const {
  std::vector<RawSocket> sockets;
  const std::string headers = http2::call_headers(evaluate_path, token);
  for (std::size_t i = 0; i < count && !end; ++i) {
    RawSocket s = connect(served, i);
    std::string bytes = opening();
    if (i % 3 != 0) bytes += http2::frame(http2::FrameType::headers, i % 3 == 1 ? 0 : http2::end_headers, 1, headers);
    if (i % 3 == 2) bytes += http2::frame(http2::FrameType::data, 0, 1, http2::message(std::string(4000, 'x')).substr(0, 100));
    if (s.send(bytes)) ++counts.half_open;
    sockets.push_back(std::move(s));
  }
  while (!end) std::this_thread::sleep_for(50ms);
}

void Hostile::send_random_bytes(const std::atomic<bool>& end) const {
  std::mt19937 random(5);
  for (std::size_t i = 0; !end; ++i) {
    RawSocket s = connect(served, i);
    std::string bytes(1 + random() % 4000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    if (i % 4 == 1) bytes = opening() + bytes;
    if (i % 4 == 2) bytes = opening() + http2::big_endian(0xffffff, 3) + bytes;
    if (i % 4 == 3) bytes = opening() + http2::frame(static_cast<http2::FrameType>(random() % 12), static_cast<std::uint8_t>(random()), static_cast<std::uint32_t>(random() % 5), bytes);
    if (s.open() && s.send(bytes)) ++counts.random_bytes;
    s.drain();
    std::this_thread::sleep_for(10ms);
  }
}

void Hostile::reset_streams(const std::atomic<bool>& end, std::uint64_t count, double per_second) const {
  const v1::EvaluateRequest request = evaluate_request("materials/a", 32);
  const std::string headers = http2::call_headers(evaluate_path, token), body = http2::message(request.SerializeAsString());
  const auto start = Clock::now();
  std::uint64_t done = 0;
  while (done < count && !end) {
    RawSocket s = connect(served, 1);
    bool open = s.send(opening());
    for (std::uint32_t stream = 1; open && done < count && !end; stream += 2) {
      std::string bytes = http2::frame(http2::FrameType::headers, http2::end_headers, stream, headers);
      if (stream % 4 == 1) bytes += http2::frame(http2::FrameType::data, http2::end_stream, stream, body);
      bytes += http2::frame(http2::FrameType::rst_stream, 0, stream, http2::big_endian(8, 4));
      open = s.send(bytes) && s.drain();
      counts.resets += static_cast<std::uint64_t>(open);
      ++done;
      while (static_cast<double>(done) > per_second * seconds_since(start) && !end) {
        std::this_thread::sleep_for(1ms);
        if (!s.drain()) open = false;
      }
    }
  }
}

void Hostile::make_bad_calls(const std::atomic<bool>& end) const {
  const auto channel = new_channel(served.address, {{GRPC_ARG_MAX_SEND_MESSAGE_LENGTH, -1}});
  const auto stub = v1::BrdfService::NewStub(channel);
  const auto call = [&](const std::string& bearer, const v1::EvaluateRequest& request) {
    Context context(2s);
    if (!bearer.empty()) context.AddMetadata("authorization", bearer);
    v1::EvaluateResponse response;
    counts.not_refused += static_cast<std::uint64_t>(stub->Evaluate(&context, request, &response).ok());
    ++counts.bad_calls;
  };
  const v1::EvaluateRequest good = evaluate_request("materials/a", 64);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; !end; ++i) {
    v1::EvaluateRequest r = good;
    switch (i % 9) {
      case 0: r.mutable_wi()->resize(std::size_t{6} << 20, 'x'); break;
      case 1: std::memcpy(r.mutable_wi()->data() + 40, &nan, 4); break;
      case 2: r.set_count(1'000'000'000); break;
      case 3: r.set_material("materials/../../etc/passwd"); break;
      case 4: r.set_material("materials/a/versions/../b"); break;
      case 5: r.mutable_wo()->resize(7); break;
      case 6: r.set_operations(0xffffffff); break;
      default: break;
    }
    if (i % 9 == 7) {
      call("", good);
    } else if (i % 9 == 8) {
      call("Bearer not-the-token-of-this-server", good);
    } else {
      call(token, r);
    }
    if (i % 20 == 0) {  // bytes that are no message of that name
      Context context(2s);
      context.AddMetadata("authorization", token);
      grpc::Slice slice("\x0a\xff\xff\xff\xff\x0f no message", 17);
      grpc::ByteBuffer request(&slice, 1), response;
      const grpc::internal::RpcMethod method(evaluate_path.data(), grpc::internal::RpcMethod::NORMAL_RPC);
      counts.not_refused += static_cast<std::uint64_t>(grpc::internal::BlockingUnaryCall<grpc::ByteBuffer, grpc::ByteBuffer>(channel.get(), method, &context, request, &response).ok());
      ++counts.bad_calls;
    }
    std::this_thread::sleep_for(20ms);
  }
}

}  // namespace brdf::load
