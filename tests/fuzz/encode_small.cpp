// SPDX-License-Identifier: Apache-2.0
// Any bytes as the values of a small table, which is compressed and decoded again.
#include <brdf/encode.h>
#include <brdf/error.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace {

/// Five bytes of shape and options, then values as floats, used over and over until the table is full.
struct Case {
  brdf::Measurement measurement;
  brdf::EncodeOptions options;
};

Case case_of(std::span<const std::uint8_t> in) {
  const auto byte = [&in]() -> int {
    if (in.empty()) return 0;
    const std::uint8_t b = in.front();
    in = in.subspan(1);
    return b;
  };
  Case c;
  brdf::HalfDifferenceTable t;
  t.n_theta_h = 2 + byte() % 12;
  t.n_theta_d = 2 + byte() % 6;
  t.n_phi_d = 2 + byte() % 8;
  const int flags = byte();
  t.full_circle = (flags & 1) != 0;
  t.position = (flags & 2) != 0 ? brdf::SamplePosition::centre : brdf::SamplePosition::edge;
  if ((flags & 4) != 0) c.measurement.channels = {brdf::ChannelModel::scalar, 1, {}};
  c.options.effort = 0;
  if ((flags & 8) != 0) c.options.reciprocity = brdf::SymmetryMode::enforce;
  c.options.store_provenance = (flags & 16) != 0;
  c.options.target_size = 32 + 8 * static_cast<std::uint64_t>(byte());
  const auto cells = static_cast<std::size_t>(t.n_theta_h * t.n_theta_d * t.n_phi_d);
  const auto channels = static_cast<std::size_t>(c.measurement.channels.count);
  std::size_t at = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    bool valid = true;
    for (std::size_t i = 0; i < channels; ++i) {
      float v = 0.25F;
      if (in.size() >= 4) {
        std::memcpy(&v, in.data() + at, 4);
        at = at + 8 <= in.size() ? at + 4 : 0;
      }
      valid = valid && std::isfinite(v) && v >= 0;  // what the readers mask
      t.values.push_back(v);
    }
    t.valid.push_back(valid ? 1 : 0);
  }
  c.measurement.table = std::move(t);
  return c;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Case c = case_of({data, std::min<std::size_t>(size, 4096)});
  std::vector<std::byte> bytes;
  try {
    bytes = brdf::compress(c.measurement, c.options).bytes;
  } catch (const brdf::Error& e) {
    if (e.code() != brdf::ErrorCode::no_data && e.code() != brdf::ErrorCode::target_not_met) std::abort();
    return 0;
  }
  if (bytes.size() > *c.options.target_size) std::abort();
  // what the encoder wrote must decode: an Error here is a finding
  const brdf::Material m = brdf::Material::decode(bytes);
  std::vector<float> f(static_cast<std::size_t>(m.channels()));
  m.eval({0.6F, 0, 0.8F}, {0, 0.28F, 0.96F}, f);
  for (const float v : f)
    if (!(std::isfinite(v) && v >= 0)) std::abort();
  return 0;
}
