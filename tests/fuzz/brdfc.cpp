// SPDX-License-Identifier: Apache-2.0
// Any bytes as a `.brdfc` file: an Error, or a material whose every answer is a number.
#include <brdf/error.h>
#include <brdf/material.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

using brdf::EvalLevel;
using brdf::Material;
using brdf::Vec3f;

void require(bool ok) {
  if (!ok) std::abort();
}

void require_number(float v) { require(std::isfinite(v) && v >= 0); }

/// From the normal to grazing, in and out of one plane.
constexpr std::array<Vec3f, 6> directions{Vec3f{0, 0, 1},         Vec3f{0.6F, 0, 0.8F},        Vec3f{-0.6F, 0, 0.8F},
                                          Vec3f{0, 0.96F, 0.28F}, Vec3f{0.9999995F, 0, 1e-3F}, Vec3f{0.28F, -0.96F, 0}};

void use(const Material& m) {
  std::vector<float> f(static_cast<std::size_t>(m.channels()));
  for (const Vec3f& wo : directions) {
    for (const Vec3f& wi : directions) {
      m.eval(wi, wo, f);
      for (const float v : f) require_number(v);
      require_number(m.pdf(wi, wo));
    }
    for (const float u : {0.0F, 0.3F, 0.7F, 0.9999999F}) {
      const brdf::Sample s = m.sample(wo, {u, 1 - u < 1 ? 1 - u : 0.5F, u}, f);
      require_number(s.pdf);
      for (const float v : f) require_number(v);
    }
  }
}

void decode(std::span<const std::byte> bytes, bool allow_prefix) {
  brdf::DecodeOptions options;
  options.allow_prefix = allow_prefix;
  options.level = EvalLevel::fast;
  options.limits.max_file_bytes = 1 << 16;
  options.limits.max_table_bytes = 1 << 20;
  options.limits.max_channels = 8;
  options.limits.max_refinements = 8;
  try {
    const Material m = Material::decode(bytes, options);
    require(m.info().refinements_read <= m.info().refinements_total);
    require(allow_prefix || m.info().refinements_read == m.info().refinements_total);
    use(m);
    use(m.prepare(EvalLevel::balanced));
  } catch (const brdf::Error&) {
    // the one answer that bad bytes may get; anything else ends the program
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  decode(bytes, false);
  decode(bytes, true);
  return 0;
}
