// SPDX-License-Identifier: Apache-2.0
#include "container/density_codes.h"

#include "residual/coefficient_model.h"

#include <brdf/error.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace brdf::container {
namespace {

/// Fills or writes the nodes of one component: what the view before says, corrected by what it said of the node before.
template <class Coder>
void code_nodes(Coder& coder, residual::CoefficientModel& model, std::span<std::int16_t> nodes) {
  constexpr std::size_t view = density_rows * density_heights;
  std::vector<std::uint8_t> magnitude(density_nodes, 0);
  for (std::size_t n = 0; n < density_nodes; ++n) {
    const std::size_t i = n % density_heights, j = n / density_heights % density_rows;
    // where nothing is known yet, the node before or the row before
    const std::size_t across = n >= view ? view : j > 0 ? density_heights : 0;
    std::int32_t expected = across > 0 ? nodes[n - across] : i > 0 ? nodes[n - 1] : 0;
    if (across > 0 && i > 0) expected += nodes[n - 1] - nodes[n - 1 - across];
    const auto near = [&](std::size_t back, bool there) { return there ? static_cast<std::uint32_t>(magnitude[n - back]) : 0U; };
    const std::uint32_t activity = 2 * near(1, i > 0) + near(across, across > 0) + near(density_heights, j > 0);
    const std::int32_t change = model.code(coder, true, residual::activity_class(activity), 0, nodes[n] - expected);
    const std::int32_t code = std::clamp(expected + change, -largest_density_code, largest_density_code);
    nodes[n] = static_cast<std::int16_t>(code);
    magnitude[n] = static_cast<std::uint8_t>(std::min(std::abs(change), 255));
  }
}

}  // namespace

std::vector<std::byte> write_density(const DensityCodes& codes) {
  std::vector<std::byte> out{static_cast<std::byte>(codes.level), static_cast<std::byte>(codes.components.size())};
  if (codes.components.size() == 2)
    for (const std::uint8_t share : codes.second) out.push_back(static_cast<std::byte>(share));
  residual::RangeEncoder coder;
  residual::CoefficientModel model;
  for (std::vector<std::int16_t> nodes : codes.components) code_nodes(coder, model, nodes);
  const std::vector<std::byte> stream = coder.finish();
  out.insert(out.end(), stream.begin(), stream.end());
  return out;
}

void check_density(std::span<const std::byte> payload, bool retro) {
  const auto refuse = [](const std::string& why) { return Error(ErrorCode::malformed, "sampling chunk: " + why); };
  if (payload.size() > most_density_bytes) throw refuse(std::to_string(payload.size()) + " bytes, at most " + std::to_string(most_density_bytes) + " are allowed");
  if (payload.size() < 2) throw refuse("it ends within its head");
  const auto level = static_cast<unsigned>(payload[0]), components = static_cast<unsigned>(payload[1]), wanted = retro ? 2U : 1U;
  if (level > static_cast<unsigned>(EvalLevel::exact)) throw refuse("level " + std::to_string(level) + " is not 0 to 2");
  if (components != wanted) throw refuse(std::to_string(components) + " components, the lobes make " + std::to_string(wanted));
  if (components == 2 && payload.size() < 2 + density_views) throw refuse("it ends within its shares");
}

DensityCodes read_density(std::span<const std::byte> payload) {
  DensityCodes codes;
  codes.level = static_cast<EvalLevel>(payload[0]);
  const auto components = static_cast<std::size_t>(payload[1]);
  payload = payload.subspan(2);
  if (components == 2) {
    for (std::size_t k = 0; k < density_views; ++k) codes.second[k] = static_cast<std::uint8_t>(payload[k]);
    payload = payload.subspan(density_views);
  }
  residual::RangeDecoder coder(payload);
  residual::CoefficientModel model;
  codes.components.assign(components, std::vector<std::int16_t>(density_nodes));
  for (std::vector<std::int16_t>& nodes : codes.components) code_nodes(coder, model, nodes);
  return codes;
}

}  // namespace brdf::container
