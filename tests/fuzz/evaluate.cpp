// SPDX-License-Identifier: Apache-2.0
// Any pair of directions, any u and any material: evaluation, pdf and sampling at each level, one by one and in batches,
// give numbers that are finite, not negative, and 0 below the horizon.
#include "fuzz/material_answers.h"
#include "fuzz/payload_parts.h"

#include <cstdint>

namespace {

using brdf::EvalLevel;
using brdf::Vec3f;

/// Input: a byte that chooses the level, nine floats, then a file as in brdfc_payload.
class Input {
 public:
  explicit Input(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  T next() {
    T value{};
    const auto part = rest_.first(std::min(sizeof(T), rest_.size()));
    std::memcpy(&value, part.data(), part.size());
    rest_ = rest_.subspan(part.size());
    return value;
  }
  /// A unit vector up to rounding; numbers that make none stand for the normal.
  Vec3f direction() {
    const double x = next<float>(), y = next<float>(), z = next<float>(), length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 1};
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
  }
  /// In [0, 1), every float of it in reach.
  float unit() {
    const float u = std::fabs(next<float>());
    return u < 1 ? u : 0x1.fffffep-1F;
  }
  std::span<const std::byte> rest() const noexcept { return rest_; }

 private:
  std::span<const std::byte> rest_;
};

/// The pair among others, so that every lane of a vector sees it.
void require_numbers_of_batch(const brdf::Material& m, const Vec3f& wi, const Vec3f& wo, const Vec3f& u) {
  constexpr std::size_t n = 19;
  const auto channels = static_cast<std::size_t>(m.channels());
  std::vector<float> planes(9 * n), drawn(3 * n), f(channels * n), pdf(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f& a = i % 2 == 0 ? wi : brdf::test::probe_directions[i % brdf::test::probe_directions.size()];
    const Vec3f& b = i % 3 == 0 ? brdf::test::probe_directions[i % brdf::test::probe_directions.size()] : wo;
    const float row[9] = {a.x, a.y, a.z, b.x, b.y, b.z, u.x, u.y, u.z};
    for (std::size_t k = 0; k < 9; ++k) planes[k * n + i] = row[k];
  }
  const auto span = [&planes](std::size_t first) {
    const float* p = planes.data() + first * n;
    return brdf::DirectionSpan{p, p + n, p + 2 * n, n};
  };
  const auto require_all = [](const std::vector<float>& values) {
    for (const float v : values) brdf::test::require_number(v);
  };
  m.eval_pdf(span(0), span(3), {f.data(), n}, pdf.data());
  require_all(f);
  require_all(pdf);
  m.sample(span(3), span(6), {drawn.data(), drawn.data() + n, drawn.data() + 2 * n, n}, pdf.data(), {f.data(), n});
  require_all(f);
  require_all(pdf);
  const bool through = (m.scatter_flags() & brdf::sample_transmission) != 0;
  for (std::size_t i = 0; i < n; ++i) brdf::test::require(pdf[i] == 0 || through || drawn[2 * n + i] > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input in(std::as_bytes(std::span(data, size)));
  const auto choice = in.next<std::uint8_t>();
  const Vec3f wi = in.direction(), wo = in.direction(), u{in.unit(), in.unit(), in.unit()};
  brdf::DecodeOptions options;
  options.limits = brdf::test::fuzz_limits();
  options.limits.max_table_bytes = 1 << 22;  // RGB at `exact`
  options.level = static_cast<EvalLevel>(choice % 3);
  options.sampling = (choice & 0x80U) == 0;
  const auto decoded = brdf::test::decode(brdf::test::payload_parts(in.rest()).build(), options);
  if (!decoded.material) return 0;
  brdf::test::require_numbers(*decoded.material, wi, wo, u);
  brdf::test::require_numbers(*decoded.material, wo, wi, u);
  require_numbers_of_batch(*decoded.material, wi, wo, u);
  return 0;
}
