// SPDX-License-Identifier: Apache-2.0
#include "rpc/error_details.h"

#include "shared/excerpt.h"

#include <google/protobuf/unknown_field_set.h>

#include <algorithm>

namespace brdf::service {
namespace {

// Clients take 8 KiB of metadata, and the sentence travels twice, once with three bytes for some of its characters.
constexpr std::size_t longest_sentence = 1024;

using google::protobuf::UnknownFieldSet;

/// Fields by number: Debian has no C++ package of google/rpc/*.proto, and these messages are a few lines each.
class Message {
 public:
  Message& add(int field, std::uint64_t value) {
    UnknownFieldSet one;
    one.AddVarint(field, value);
    return append(one);
  }
  Message& add(int field, const std::string& value) {
    UnknownFieldSet one;
    *one.AddLengthDelimited(field) = value;
    return append(one);
  }
  Message& add(int field, const Message& value) { return add(field, value.wire_); }

  const std::string& wire() const noexcept { return wire_; }

 private:
  Message& append(const UnknownFieldSet& fields) {
    std::string bytes;
    fields.SerializeToString(&bytes);
    wire_ += bytes;
    return *this;
  }

  std::string wire_;
};

/// google.protobuf.Any
Message any(const std::string& type, const Message& value) { return Message().add(1, "type.googleapis.com/google.rpc." + type).add(2, value); }

}  // namespace

grpc::Status detailed_status(grpc::StatusCode code, const std::string& sentence, const ErrorDetails& details) {
  const std::string text = utf8_prefix(sentence, longest_sentence);
  Message status;  // google.rpc.Status: code, message, details
  status.add(1, static_cast<std::uint64_t>(code)).add(2, text);
  status.add(3, any("ErrorInfo", Message().add(1, details.reason).add(2, error_domain)));  // reason, domain
  if (!details.field.empty()) {
    const Message violation = Message().add(1, details.field).add(2, text);  // field, description
    status.add(3, any("BadRequest", Message().add(1, violation)));
  }
  if (details.retry) {
    const auto ms = static_cast<std::uint64_t>(std::max<std::int64_t>(details.retry->count(), 0));
    const Message duration = Message().add(1, ms / 1000).add(2, ms % 1000 * 1'000'000);  // google.protobuf.Duration: seconds, nanos
    status.add(3, any("RetryInfo", Message().add(1, duration)));
  }
  return {code, text, status.wire()};
}

}  // namespace brdf::service
