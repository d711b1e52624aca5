// SPDX-License-Identifier: Apache-2.0
#include "container/purpose_codes.h"

#include "container/error_codes.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace brdf::container {
namespace {

constexpr std::size_t payload_bytes = 9;
constexpr double half_degree = std::numbers::pi / 360;
constexpr std::uint8_t right_angle = 180;  // half degrees
constexpr int whole = 255;                 // code of a share of 1
constexpr int one_pixel = 64;

std::uint8_t angle_code(double half_degrees) noexcept { return static_cast<std::uint8_t>(std::clamp(half_degrees, 0.0, static_cast<double>(right_angle))); }

/// 0 = exactly 0, else 2^((code - one) / 8).
double power_of(std::uint8_t code, int one) noexcept { return code == 0 ? 0.0 : std::exp2((code - one) / 8.0); }
std::uint8_t power_code(double v, int one) noexcept {
  if (!(v > 0)) return 0;
  return static_cast<std::uint8_t>(std::clamp(std::round(std::log2(v) * 8.0 + one), 1.0, 255.0));
}

}  // namespace

std::vector<std::byte> write_purpose(const FittedFor& p) {
  const auto level = static_cast<unsigned>(p.level);
  const std::array<std::uint8_t, payload_bytes> codes = {
      static_cast<std::uint8_t>((p.operations & 0x0FU) | level << 4),
      angle_code(std::floor(static_cast<double>(p.theta_i_least) / half_degree)),
      angle_code(std::ceil(static_cast<double>(p.theta_i_most) / half_degree)),
      angle_code(std::floor(static_cast<double>(p.theta_o_least) / half_degree)),
      angle_code(std::ceil(static_cast<double>(p.theta_o_most) / half_degree)),
      power_code(p.share, whole),
      power_code(p.footprint_pixels, one_pixel),
      log_mae_code(p.rms),
      log_mae_code(p.log_error),
  };
  std::vector<std::byte> out;
  for (const std::uint8_t c : codes) out.push_back(static_cast<std::byte>(c));
  return out;
}

FittedFor read_purpose(std::span<const std::byte> payload) {
  if (payload.size() != payload_bytes)
    throw Error(ErrorCode::malformed, "fitted-for chunk: " + std::to_string(payload.size()) + " bytes, " + std::to_string(payload_bytes) + " are wanted");
  const auto code = [&](std::size_t i) { return static_cast<std::uint8_t>(payload[i]); };
  FittedFor p;
  const unsigned level = code(0) >> 4;
  if (level > static_cast<unsigned>(EvalLevel::exact))
    throw Error(ErrorCode::malformed, "fitted-for chunk: evaluation level " + std::to_string(level) + ", 0 to 2 are allowed");
  p.operations = code(0) & 0x0FU;
  p.level = static_cast<EvalLevel>(level);
  float* const angles[] = {&p.theta_i_least, &p.theta_i_most, &p.theta_o_least, &p.theta_o_most};
  for (std::size_t i = 0; i < 4; ++i) {
    if (code(i + 1) > right_angle)
      throw Error(ErrorCode::malformed, "fitted-for chunk: an angle of " + std::to_string(code(i + 1)) + " half degrees, at most 180 are allowed");
    *angles[i] = static_cast<float>(code(i + 1) * half_degree);
  }
  p.share = power_of(code(5), whole);
  p.footprint_pixels = power_of(code(6), one_pixel);
  p.rms = log_mae_of(code(7));
  p.log_error = log_mae_of(code(8));
  return p;
}

}  // namespace brdf::container
