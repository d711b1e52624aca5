// SPDX-License-Identifier: Apache-2.0
#include "profile/saturating.h"

#include <brdf/error.h>
#include <brdf/profile.h>

#include <algorithm>

namespace brdf {

using profile::add_saturating;

const char* to_string(ProfileOperation operation) noexcept {
  switch (operation) {
    case ProfileOperation::eval: return "eval";
    case ProfileOperation::sample: return "sample";
    case ProfileOperation::pdf: return "pdf";
    case ProfileOperation::transmission: return "transmission";
  }
  return "unknown";
}

MaterialProfile::MaterialProfile() : histogram(static_cast<std::size_t>(ProfileGrid::cells), 0) {}

void MaterialProfile::add(const ProfilePlace& place, double contribution) noexcept {
  const std::uint64_t c = profile::fixed_point(contribution, units, largest_contribution);
  if (c == 0) return;
  if (place.transmission) {
    add_saturating(transmitted, c);
    add_saturating(contributions, 1);
    return;
  }
  if (place.cell >= histogram.size()) return;
  add_saturating(contributions, 1);
  add_saturating(histogram[place.cell], c);
  add_saturating(phi_h[place.phi_h], c);
  add_saturating(theta_i[place.theta_i_bin], c);
  add_saturating(theta_o[place.theta_o_bin], c);
  range_i.least = std::min(range_i.least, place.theta_i);
  range_i.most = std::max(range_i.most, place.theta_i);
  range_o.least = std::min(range_o.least, place.theta_o);
  range_o.most = std::max(range_o.most, place.theta_o);
}

void MaterialProfile::merge(const MaterialProfile& other) noexcept {
  const auto all = [](auto& sums, const auto& more) {
    for (std::size_t i = 0; i < sums.size() && i < more.size(); ++i) add_saturating(sums[i], more[i]);
  };
  all(operations, other.operations);
  add_saturating(contributions, other.contributions);
  all(histogram, other.histogram);
  all(phi_h, other.phi_h);
  all(theta_i, other.theta_i);
  all(theta_o, other.theta_o);
  range_i = {std::min(range_i.least, other.range_i.least), std::max(range_i.most, other.range_i.most)};
  range_o = {std::min(range_o.least, other.range_o.least), std::max(range_o.most, other.range_o.most)};
  add_saturating(transmitted, other.transmitted);
  add_saturating(footprint, other.footprint);
  add_saturating(first_hits, other.first_hits);
}

double MaterialProfile::contribution() const noexcept {
  double sum = 0;
  for (const std::uint64_t c : histogram) sum += static_cast<double>(c);
  return sum / units;
}

void Profile::merge(const Profile& other) {
  for (const auto& [slot, asked] : other.materials) materials[slot].merge(asked);
}

double Profile::share(std::string_view slot) const noexcept {
  const auto of = [](const MaterialProfile& m) { return m.contribution() + static_cast<double>(m.transmitted) / MaterialProfile::units; };
  const auto found = materials.find(slot);
  if (found == materials.end()) return 0;
  double all = 0;
  for (const auto& entry : materials) all += of(entry.second);
  return all > 0 ? of(found->second) / all : 0;
}

const MaterialProfile& Profile::at(std::string_view slot) const& {
  const auto found = materials.find(slot);
  if (found != materials.end()) return found->second;
  std::string names;
  for (const auto& entry : materials) names += (names.empty() ? "" : ", ") + entry.first;
  throw Error(ErrorCode::invalid_argument,
              "the profile has no material '" + std::string(slot) + "'" + (names.empty() ? ": it is empty" : "; it has " + names));
}

}  // namespace brdf
