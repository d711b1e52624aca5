// SPDX-License-Identifier: Apache-2.0
#include "container/packed_lobes.h"

#include "container/bit_stream.h"
#include "container/lobe_quantiser.h"

namespace brdf::container {

LobeSet read_packed_lobes(std::span<const std::byte> bytes, int channels, std::uint32_t max_lobes) {
  BitReader in(bytes, "lobes chunk");
  const auto code = [&in] { return static_cast<std::int32_t>(in.get(lobe_code_bits)); };
  LobeSet set;
  set.channels = channels;
  const std::uint32_t count = in.get(lobe_count_bits);
  check_lobe_count(count, max_lobes);
  const int exponent = exponent_of(in.get(exponent_bits));
  for (std::uint32_t i = 0; i < count; ++i) {
    Lobe lobe;
    const std::uint32_t kind = in.get(3);
    if (kind > static_cast<std::uint32_t>(LobeKind::retro_ggx))
      throw Error(ErrorCode::unsupported, "lobes: kind " + std::to_string(kind) + " is not known to this version");
    lobe.kind = static_cast<LobeKind>(kind);
    if (has_microfacets(lobe.kind)) {
      lobe.alpha = alpha_of(code());
      lobe.f90 = amplitude_of(code(), exponent);
    }
    lobe.color.resize(static_cast<std::size_t>(channels));
    for (double& c : lobe.color) c = amplitude_of(code(), exponent);
    set.lobes.push_back(std::move(lobe));
  }
  if (!in.rest().empty()) throw Error(ErrorCode::malformed, "lobes chunk: bytes are left over");
  return set;
}

}  // namespace brdf::container
