// SPDX-License-Identifier: Apache-2.0
// What holds for any bytes as a `.brdfc` file: check_file and decode agree, and whatever is decoded answers in numbers.
#pragma once

#include <brdf/check.h>
#include <brdf/error.h>
#include <brdf/material.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace brdf::test {

/// Ends the program, which is what a fuzzer takes for a finding.
inline void require(bool ok) {
  if (!ok) std::abort();
}

inline void require_number(float v) { require(std::isfinite(v) && v >= 0); }

/// Small enough for thousands of files a second; the table of no level but `fast` fits any file.
inline DecodeLimits fuzz_limits() {
  DecodeLimits limits;
  limits.max_file_bytes = 1 << 16;
  limits.max_table_bytes = 1 << 20;
  limits.max_temporary_bytes = 1 << 24;
  limits.max_channels = 8;
  limits.max_refinements = 8;
  return limits;
}

/// f, the density and samples of one pair of unit vectors and one u in [0, 1)^3.
inline void require_numbers(const Material& m, const Vec3f& wi, const Vec3f& wo, const Vec3f& u) {
  std::vector<float> f(static_cast<std::size_t>(m.channels()));
  const bool above = wi.z > 0 && wo.z > 0;
  m.eval(wi, wo, f);
  for (const float v : f) {
    require_number(v);
    require(above || v == 0);
  }
  const float pdf = m.eval_pdf(wi, wo, f);
  require_number(pdf);
  require(above || pdf == 0);
  for (const float v : f) require_number(v);
  const Sample s = m.sample(wo, u, f);
  require_number(s.pdf);
  for (const float v : f) require_number(v);
  if (s.flags == sample_none) {
    require(s.pdf == 0);
    return;
  }
  require((s.flags & ~m.scatter_flags()) == 0);
  // by signs: the product of two tiny cosines is 0
  require(s.pdf > 0 && s.wi.z != 0 && ((s.flags & sample_transmission) != 0) == ((s.wi.z > 0) != (wo.z > 0)));
  const float length = std::sqrt(s.wi.x * s.wi.x + s.wi.y * s.wi.y + s.wi.z * s.wi.z);
  require(std::fabs(length - 1) < 1e-4F);
}

/// From the normal to grazing, in and out of one plane, and below the horizon.
inline constexpr std::array<Vec3f, 7> probe_directions{Vec3f{0, 0, 1},        Vec3f{0.6F, 0, 0.8F},         Vec3f{-0.6F, 0, 0.8F},
                                                       Vec3f{0, 0.96F, 0.28F}, Vec3f{0.9999995F, 0, 1e-3F}, Vec3f{0.28F, -0.96F, 0},
                                                       Vec3f{0, 0.6F, -0.8F}};

inline void require_numbers(const Material& m) {
  constexpr float below_one = 0x1.fffffep-1F;
  float u = 0;
  for (const Vec3f& wo : probe_directions)
    for (const Vec3f& wi : probe_directions) {
      require_numbers(m, wi, wo, {u, u < 0.5F ? below_one - u : u, u});
      u = u < 0.9F ? u + 0.137F : (u == below_one ? 0 : below_one);
    }
}

/// What decoding at a level gives: a material or an error.
struct Decoded {
  std::optional<Material> material;
  std::optional<Error> error;
};

inline Decoded decode(std::span<const std::byte> bytes, const DecodeOptions& options) {
  try {
    return {Material::decode(bytes, options), std::nullopt};
  } catch (const Error& e) {
    return {std::nullopt, e};
  }
}

/// Decodes at one level and holds the outcome against what check_file said.
inline std::optional<Material> decode_as_checked(std::span<const std::byte> bytes, const FileCheck& check, DecodeOptions options,
                                                 EvalLevel level) {
  options.level = level;
  const Decoded found = decode(bytes, options);
  const std::optional<Error>& expected = check.problem ? check.problem : check.at(level).problem;
  require(found.error.has_value() == expected.has_value());
  if (found.error) {
    require(found.error->code() == expected->code() && std::strcmp(found.error->what(), expected->what()) == 0);
    require(std::strlen(expected->what()) > 0);
    return std::nullopt;
  }
  const MaterialInfo& info = found.material->info();
  require(info.refinements_read == check.refinements_read && info.refinements_total == check.refinements_total);
  require(info.refinements_read <= info.refinements_total);
  require(options.allow_prefix || info.refinements_read == info.refinements_total);
  require(found.material->channels() == check.channels);
  require(found.material->sampling_bytes() == (options.sampling ? check.sampling_bytes : 0));
  return found.material;
}

/// Every level of a file, each handed to `use`; the balanced one is prepared for sampling.
template <class Use>
void check_every_level(std::span<const std::byte> bytes, bool allow_prefix, Use&& use) {
  DecodeOptions options;
  options.limits = fuzz_limits();
  options.allow_prefix = allow_prefix;
  const FileCheck check = check_file(bytes, options.limits, allow_prefix);
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    options.sampling = level == EvalLevel::balanced;  // its tables are most of the time that a level takes
    const std::optional<Material> m = decode_as_checked(bytes, check, options, level);
    if (!m) continue;
    use(*m);
    if (level != EvalLevel::fast) continue;
    bool refused = false;
    try {
      (void)m->prepare(EvalLevel::exact);
    } catch (const Error&) {
      refused = true;
    }
    require(refused == check.at(EvalLevel::exact).problem.has_value());
  }
}

}  // namespace brdf::test
