// SPDX-License-Identifier: Apache-2.0
#include "direction_text.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>

namespace brdf::cli {

Vec3f parse_direction(const std::string& option, const std::string& text) {
  const auto refuse = [&](const std::string& why) -> CLI::ValidationError {
    return CLI::ValidationError(option, "is '" + text + "', " + why);
  };
  Vec3d w{0, 0, 0};
  const char *at = text.data(), *end = at + text.size();
  for (glm::length_t k = 0; k < 3; ++k) {
    const auto [rest, error] = std::from_chars(at, end, w[k]);
    const bool separated = k == 2 ? rest == end : rest != end && *rest == ',';
    if (error != std::errc{} || !separated) throw refuse("wanted are three numbers X,Y,Z");
    at = rest + 1;
  }
  const double length = std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
  if (!(std::abs(length - 1) <= 1e-3)) throw refuse("its length must be 1 within 0.001");
  // A direction that is as near to unit as floats can be is kept to the last bit.
  return std::abs(length - 1) < 2e-7 ? Vec3f(w) : Vec3f(w / length);
}

}  // namespace brdf::cli
