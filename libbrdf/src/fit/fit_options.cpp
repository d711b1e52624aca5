// SPDX-License-Identifier: Apache-2.0
#include <brdf/fit.h>

namespace brdf {
namespace {

bool in_range(const char* name, int value, int low, int high, std::string* why) {
  if (value >= low && value <= high) return true;
  if (why != nullptr) {
    *why = std::string("FitOptions::") + name + " is " + std::to_string(value) + "; allowed are " +
           std::to_string(low) + " to " + std::to_string(high);
  }
  return false;
}

}  // namespace

bool FitOptions::is_valid(std::string* why) const {
  return in_range("max_lobes", max_lobes, 1, 8, why) && in_range("starts", starts, 1, 1000, why) &&
         in_range("max_iterations", max_iterations, 1, 100000, why) &&
         in_range("samples", samples, 100, 10000000, why) && in_range("threads", threads, 1, 1024, why);
}

}  // namespace brdf
