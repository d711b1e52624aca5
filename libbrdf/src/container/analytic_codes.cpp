// SPDX-License-Identifier: Apache-2.0
#include "container/analytic_codes.h"

#include "analytic/model_check.h"
#include "base/byte_reader.h"

#include <brdf/error.h>

#include <string>

namespace brdf::container {
namespace {

enum Kind : unsigned { lambert = 0, ggx = 1, mirror = 2, dielectric = 3, kind_count = 4 };
static_assert(std::variant_size_v<AnalyticModel> == kind_count);

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::malformed, "analytic chunk: " + what); }

/// Floats one after the other; the length has been checked.
class Floats {
 public:
  explicit Floats(std::span<const std::byte> bytes) : bytes_(bytes) {}
  float next() {
    const auto v = base::load_little_endian<float>(bytes_);
    bytes_ = bytes_.subspan(sizeof(float));
    return v;
  }
  std::vector<float> next(std::size_t count) {
    std::vector<float> all(count);
    for (float& v : all) v = next();
    return all;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

AnalyticModel read_analytic(std::span<const std::byte> payload, const Component& component) {
  if (payload.empty()) refuse("it is empty");
  const auto first = static_cast<unsigned>(payload[0]), kind = first & analytic_kind_bits;
  if (kind >= kind_count)
    throw Error(ErrorCode::unsupported, "analytic chunk: kind " + std::to_string(kind) + " is not known to this version");
  const bool anisotropic = (first & analytic_anisotropic) != 0, compensated = (first & analytic_compensated) != 0;
  if ((first & analytic_reserved) != 0 || (kind != ggx && (anisotropic || compensated))) refuse("reserved bits are set");
  const auto n = static_cast<std::size_t>(component.channels.count);
  const std::size_t values = kind == dielectric ? 1 : n + (kind == ggx ? (anisotropic ? 2U : 1U) : 0U), length = 1 + values * sizeof(float);
  if (payload.size() != length) refuse(std::to_string(payload.size()) + " bytes, its kind and channels need " + std::to_string(length));
  Floats floats(payload.subspan(1));
  AnalyticModel model;
  switch (kind) {
    case lambert: model = Lambert{floats.next(n)}; break;
    case ggx: {
      const float x = floats.next(), y = anisotropic ? floats.next() : x;
      if (anisotropic && x == y) refuse("two roughnesses that are the same");
      model = GgxReflector{x, y, floats.next(n), compensated};
      break;
    }
    case mirror: model = Mirror{floats.next(n)}; break;
    default: model = Dielectric{floats.next(), component.channels.count}; break;
  }
  if (const auto problem = analytic::problem_of(model)) refuse(*problem);
  if (component.axes != AxesKind::half_difference || component.transform != residual::ChannelTransform::identity ||
      !component.mirror_symmetric || component.reciprocal != analytic::is_reciprocal(model))
    refuse("the component declares axes, a channel transform or symmetries that its model does not have");
  return model;
}

}  // namespace brdf::container
