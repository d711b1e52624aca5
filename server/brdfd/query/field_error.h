// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/error.h>

#include <string>

namespace brdf::service {

/// A field of a request that has no meaning; clients are told which one by name, and not only in the sentence "FIELD WHY".
class FieldError : public Error {
 public:
  FieldError(const std::string& field, const std::string& why) : Error(ErrorCode::invalid_argument, field + " " + why), field_(field) {}
  /// As the proto file has it, with dots for those of inner messages.
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_;
};

}  // namespace brdf::service
