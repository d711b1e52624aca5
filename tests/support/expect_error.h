// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/error.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace brdf::test {

/// Runs `action`, which must throw brdf::Error of that code whose sentence holds every one of `words`.
template <class Action>
void expect_error(ErrorCode code, std::initializer_list<const char*> words, Action&& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_STREQ(to_string(e.code()), to_string(code)) << e.what();
    for (const char* word : words) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << "'" << word << "' is not in: " << e.what();
    }
    return;
  }
  ADD_FAILURE() << "no error, expected " << to_string(code);
}

}  // namespace brdf::test
