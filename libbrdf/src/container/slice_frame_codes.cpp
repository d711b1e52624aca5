// SPDX-License-Identifier: Apache-2.0
#include "container/slice_frame_codes.h"

#include "container/bit_stream.h"
#include "residual/coefficient_model.h"
#include "residual/residual_code.h"

#include <brdf/error.h>

#include <algorithm>
#include <cmath>

namespace brdf::container {
namespace {

constexpr int count_bits = 5, width_bits = 7, height_bits = 7, rows_bits = 8, step_bits = 5, epsilon_bits = 8, ndf_count_bits = 8,
              first_bits = 16, length_bits = 11;
constexpr double largest_log2_ndf = 30;  // and its negative: every product stays in the range of float

/// The ndf as second differences: it is smooth. Fills or reads frame.ndf from its third value on.
template <class Coder>
void code_ndf(Coder& coder, std::vector<std::int16_t>& ndf) {
  residual::CoefficientModel model;
  std::int32_t last = 0, before_last = 0;
  for (std::size_t i = 1; i < ndf.size(); ++i) {
    const std::int32_t one = ndf[i - 1], two = i > 1 ? ndf[i - 2] : ndf[0], expected = 2 * one - two;
    const auto activity = residual::activity_class(static_cast<std::uint32_t>(2 * std::min(std::abs(last), 40) + std::min(std::abs(before_last), 40)));
    const std::int32_t change = model.code(coder, true, activity, 0, ndf[i] - expected);
    if (std::abs(expected + change) > 32767) throw Error(ErrorCode::malformed, "slice frame: the ndf leaves its range");
    ndf[i] = static_cast<std::int16_t>(expected + change);
    before_last = last;
    last = change;
  }
}

}  // namespace

bool is_valid(const residual::SliceFrame& f, const char*& why) noexcept {
  const auto ok = [&why](bool condition, const char* sentence) {
    if (!condition) why = sentence;
    return condition;
  };
  if (!ok(f.theta_i.size() >= 2 && f.theta_i.size() <= static_cast<std::size_t>(residual::max_m), "it has fewer than 2 or more than 24 slices")) return false;
  if (!ok(std::adjacent_find(f.theta_i.begin(), f.theta_i.end(), [](auto a, auto b) { return a >= b; }) == f.theta_i.end(), "theta_i does not ascend")) return false;
  if (!ok(f.width >= 2 && f.width <= residual::max_k, "its width is not 2 to 64")) return false;
  if (!ok(f.height >= 2 && f.half_height() <= residual::max_l, "its height is not 2 to 64")) return false;
  if (!ok(f.rows >= 4, "its density has fewer than 4 rows")) return false;
  if (!ok(f.ndf_step <= residual::max_ndf_step, "the step of its ndf is not 0 to 20")) return false;
  if (!ok(f.ndf.size() >= 3 && f.ndf.size() <= 255, "its ndf has fewer than 3 or more than 255 nodes")) return false;
  if (!ok(f.epsilon <= residual::largest_epsilon_code, "its epsilon is out of range")) return false;
  const double largest = largest_log2_ndf * std::exp2(0.5 * f.ndf_step);
  return ok(std::all_of(f.ndf.begin(), f.ndf.end(), [largest](std::int16_t c) { return std::abs(c) <= largest; }), "its ndf leaves 2^-30 to 2^30");
}

std::vector<std::byte> write_slice_frame(const residual::SliceFrame& f) {
  residual::RangeEncoder coder;
  std::vector<std::int16_t> ndf = f.ndf;
  code_ndf(coder, ndf);
  const std::vector<std::byte> curve = coder.finish();
  BitWriter bits;
  bits.put(static_cast<std::uint32_t>(f.theta_i.size()), count_bits);
  bits.put(f.width, width_bits);
  bits.put(f.height, height_bits);
  bits.put(f.rows, rows_bits);
  bits.put(f.ndf_step, step_bits);
  bits.put(f.epsilon, epsilon_bits);
  bits.put(static_cast<std::uint32_t>(f.ndf.size()), ndf_count_bits);
  bits.put(static_cast<std::uint16_t>(f.ndf.front()), first_bits);
  bits.put(static_cast<std::uint32_t>(curve.size()), length_bits);
  for (const std::uint16_t theta : f.theta_i) bits.put(theta, 16);
  std::vector<std::byte> out = bits.bytes();
  out.insert(out.end(), curve.begin(), curve.end());
  return out;
}

residual::SliceFrame read_slice_frame(std::span<const std::byte>& bytes) {
  BitReader bits(bytes, "slice frame");
  residual::SliceFrame f;
  f.theta_i.resize(bits.get(count_bits));
  f.width = static_cast<std::uint8_t>(bits.get(width_bits));
  f.height = static_cast<std::uint8_t>(bits.get(height_bits));
  f.rows = static_cast<std::uint8_t>(bits.get(rows_bits));
  f.ndf_step = static_cast<std::uint8_t>(bits.get(step_bits));
  f.epsilon = static_cast<std::uint8_t>(bits.get(epsilon_bits));
  f.ndf.resize(std::max<std::size_t>(bits.get(ndf_count_bits), 1));
  f.ndf[0] = static_cast<std::int16_t>(bits.get(first_bits));
  const std::uint32_t length = bits.get(length_bits);
  for (std::uint16_t& theta : f.theta_i) theta = static_cast<std::uint16_t>(bits.get(16));
  const std::span<const std::byte> rest = bits.rest();
  if (length > rest.size())
    throw Error(ErrorCode::malformed, "slice frame: its ndf has " + std::to_string(length) + " bytes, " + std::to_string(rest.size()) + " are left");
  residual::RangeDecoder coder(rest.first(length));
  code_ndf(coder, f.ndf);
  if (coder.overrun() > 4) throw Error(ErrorCode::malformed, "slice frame: the ndf goes on beyond its end");
  const char* why = "";
  if (!is_valid(f, why)) throw Error(ErrorCode::malformed, std::string("slice frame: ") + why);
  bytes = rest.subspan(length);
  return f;
}

}  // namespace brdf::container
