// SPDX-License-Identifier: Apache-2.0
// Prints the bits of what brdf::decode makes of files: f, pdf and samples at fixed directions, at every level. Two builds
// of the library agree when they print the same.
// usage: print_values FILE.brdfc...
#include <brdf/material.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

void print_bits(const std::vector<float>& values) {
  for (const float v : values) {
    std::uint32_t bits;
    std::memcpy(&bits, &v, sizeof bits);
    std::printf(" %08x", bits);
  }
  std::printf("\n");
}

/// From integers alone, on a sphere by rational numbers: no function of the mathematics library.
std::vector<brdf::Vec3f> directions() {
  std::vector<brdf::Vec3f> all = {{0, 0, 1}, {1, 0, 1e-6f}, {-1, 0, 1e-6f}, {0.6f, 0, 0.8f}};
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k) {
      const float a = 0.3f * static_cast<float>(i), b = 0.29f * static_cast<float>(k), r2 = a * a + b * b;
      if (r2 < 1) all.push_back({2 * a / (1 + r2), 2 * b / (1 + r2), (1 - r2) / (1 + r2)});
    }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<brdf::Vec3f> w = directions();
  for (int file = 1; file < argc; ++file) {
    std::ifstream in(argv[file], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    for (const brdf::EvalLevel level : {brdf::EvalLevel::fast, brdf::EvalLevel::balanced, brdf::EvalLevel::exact}) {
      brdf::DecodeOptions options;
      options.level = level;
      const brdf::Material m = brdf::Material::decode(std::as_bytes(std::span(text.data(), text.size())), options);
      const auto channels = static_cast<std::size_t>(m.channels());
      std::printf("%d %s", file, brdf::to_string(level));
      std::vector<float> values, row(channels);
      for (const brdf::Vec3f& wo : w)
        for (std::size_t i = 0; i < w.size(); ++i) {
          values.push_back(m.eval_pdf(w[i], wo, row));
          values.insert(values.end(), row.begin(), row.end());
          const float u = static_cast<float>(i) / static_cast<float>(w.size());
          const brdf::Sample s = m.sample(wo, {u, 1 - 0.9f * u, 0.5f * u + 0.25f}, row);
          values.insert(values.end(), {s.wi.x, s.wi.y, s.wi.z, s.pdf});
          values.insert(values.end(), row.begin(), row.end());
        }
      std::vector<float> x, y, z, ox, oy, oz;
      for (const brdf::Vec3f& a : w)
        for (const brdf::Vec3f& b : w) {
          x.push_back(a.x), y.push_back(a.y), z.push_back(a.z);
          ox.push_back(b.x), oy.push_back(b.y), oz.push_back(b.z);
        }
      std::vector<float> f(channels * x.size());
      m.eval({x.data(), y.data(), z.data(), x.size()}, {ox.data(), oy.data(), oz.data(), x.size()}, {f.data(), x.size()});
      values.insert(values.end(), f.begin(), f.end());
      print_bits(values);
    }
  }
  return argc > 1 ? 0 : 2;
}
