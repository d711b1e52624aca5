// SPDX-License-Identifier: Apache-2.0
// What lies behind the checksums, which a fuzzer cannot guess: the input is cut into a component declaration and chunk
// payloads, and the header and checksums are made to fit.
#include "support/brdfc_parts.h"

#include <brdf/error.h>
#include <brdf/material.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace {

/// Input: component bytes behind their count, then chunks, each a code and a length byte before its payload.
brdf::test::FileParts parts(std::span<const std::byte> in) {
  const auto take = [&in](std::size_t n) {
    const auto part = in.first(std::min(n, in.size()));
    in = in.subspan(part.size());
    return std::vector<std::byte>(part.begin(), part.end());
  };
  const auto number = [&take] {
    const auto byte = take(1);
    return byte.empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(byte[0]);
  };
  brdf::test::FileParts p;
  p.component = take(number());
  while (!in.empty()) {
    const std::uint8_t code = number(), length = number();
    p.chunks.push_back({code, take(length), std::nullopt});
  }
  return p;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::byte> file = parts(std::as_bytes(std::span(data, size))).build();
  brdf::DecodeOptions options;
  options.limits.max_table_bytes = 1 << 20;
  options.limits.max_channels = 8;
  options.limits.max_refinements = 8;
  try {
    const brdf::Material m = brdf::Material::decode(file, options);
    std::vector<float> f(static_cast<std::size_t>(m.channels()));
    for (const brdf::Vec3f& wi : {brdf::Vec3f{0, 0, 1}, brdf::Vec3f{0.6F, 0, 0.8F}, brdf::Vec3f{0, 0.9999995F, 1e-3F}})
      for (const brdf::Vec3f& wo :
           {brdf::Vec3f{0, 0, 1}, brdf::Vec3f{-0.6F, 0, 0.8F}, brdf::Vec3f{0.9999995F, 0, 1e-3F}}) {
        const float pdf = m.eval_pdf(wi, wo, f);
        if (!(std::isfinite(pdf) && pdf >= 0)) std::abort();
        for (const float v : f)
          if (!(std::isfinite(v) && v >= 0)) std::abort();
      }
  } catch (const brdf::Error&) {
    // the one answer that bad fields may get
  }
  return 0;
}
