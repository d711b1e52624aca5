// SPDX-License-Identifier: Apache-2.0
#include "support/numeric_bound.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace brdf::test {

namespace {

std::vector<const NumericBound*>& registry() {
  static std::vector<const NumericBound*> all;
  return all;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", v);
  return text;
}

/// Writes the record when all tests have run.
class Record : public testing::Environment {
 public:
  void TearDown() override {
    const char* file = std::getenv("BRDF_NUMERICS_JSON");
    if (file == nullptr) return;
    std::ofstream out(file);
    out << "[\n";
    bool first = true;
    for (const NumericBound* b : registry()) {
      out << (first ? "" : ",\n") << "{\"group\": " << quoted(b->group()) << ", \"what\": " << quoted(b->what())
          << ", \"unit\": " << quoted(b->unit()) << ", \"bound\": " << number(b->bound()) << ", \"worst\": "
          << (b->cases() > 0 ? number(b->worst()) : "null") << ", \"where\": " << quoted(b->where())
          << ", \"cases\": " << b->cases() << "}";
      first = false;
    }
    out << "\n]\n";
    EXPECT_TRUE(out.flush()) << file;
  }
};

}  // namespace

NumericBound::NumericBound(std::string group, std::string what, std::string unit, double bound)
    : group_(std::move(group)), what_(std::move(what)), unit_(std::move(unit)), bound_(bound) {
  if (registry().empty()) testing::AddGlobalTestEnvironment(new Record);  // GoogleTest deletes it
  registry().push_back(this);
}

void NumericBound::check() const {
  EXPECT_GT(cases_, 0U) << group_ << ", " << what_ << ": nothing was tested";
  EXPECT_LE(worst_, bound_) << group_ << ", " << what_ << " [" << unit_ << "], worst of " << cases_ << " at " << where_;
}

const std::vector<const NumericBound*>& numeric_bounds() { return registry(); }

std::string numbers(std::initializer_list<double> values) {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : " ") + number(v);
  return out;
}

}  // namespace brdf::test
