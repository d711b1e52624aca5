// SPDX-License-Identifier: Apache-2.0
#include "base/byte_reader.h"
#include "container/analytic_codes.h"

#include <span>

namespace brdf::container {
namespace {

struct Writer {
  std::vector<std::byte> out;

  void put(float v) {
    std::byte raw[sizeof v];
    base::store_little_endian(v, std::span<std::byte>(raw));
    out.insert(out.end(), raw, raw + sizeof v);
  }
  void put(const std::vector<float>& values) {
    for (const float v : values) put(v);
  }
  void operator()(const Lambert& m) { put(m.albedo); }
  void operator()(const GgxReflector& m) {
    put(m.alpha_x);
    if (m.alpha_x != m.alpha_y) {
      out[0] |= static_cast<std::byte>(analytic_anisotropic);
      put(m.alpha_y);
    }
    if (m.multiple_scattering) out[0] |= static_cast<std::byte>(analytic_compensated);
    put(m.f0);
  }
  void operator()(const Mirror& m) { put(m.reflectance); }
  void operator()(const Dielectric& m) { put(m.ior); }
};

}  // namespace

std::vector<std::byte> write_analytic(const AnalyticModel& model) {
  Writer w{{static_cast<std::byte>(model.index())}};
  std::visit(w, model);
  return w.out;
}

}  // namespace brdf::container
