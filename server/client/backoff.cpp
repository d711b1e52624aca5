// SPDX-License-Identifier: Apache-2.0
#include "client/backoff.h"

#include <algorithm>
#include <charconv>
#include <thread>

namespace brdf::client {
namespace {

using std::chrono::milliseconds;
constexpr int most_attempts = 4;
constexpr milliseconds first_wait{20}, longest_wait{500}, longest_pushback{2000};

/// What the server asks for; negative: not at all.
milliseconds pushback(const grpc::ClientContext& context, milliseconds otherwise) {
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto found = trailers.find("grpc-retry-pushback-ms");
  if (found == trailers.end()) return otherwise;
  int value = -1;
  const char* end = found->second.data() + found->second.size();
  const auto [rest, error] = std::from_chars(found->second.data(), end, value);
  return error != std::errc{} || rest != end ? milliseconds(-1) : std::min(milliseconds(value), longest_pushback);
}

}  // namespace

milliseconds Backoff::left() const { return std::chrono::duration_cast<milliseconds>(until_ - std::chrono::system_clock::now()); }

bool Backoff::again(const grpc::Status& status, const grpc::ClientContext& context) {
  if (status.error_code() != grpc::StatusCode::UNAVAILABLE && status.error_code() != grpc::StatusCode::RESOURCE_EXHAUSTED) return false;
  if (++failures_ >= most_attempts) return false;
  milliseconds wait = first_wait;
  for (int i = 1; i < failures_; ++i) wait = std::min(3 * wait, longest_wait);
  wait = pushback(context, wait);
  if (wait.count() < 0 || wait >= left()) return false;
  std::this_thread::sleep_for(wait);
  return true;
}

}  // namespace brdf::client
