// SPDX-License-Identifier: Apache-2.0
#include "repository/material_version.h"

#include "query/field_error.h"
#include "shared/content_hash.h"

#include <brdf/error.h>

#include <algorithm>

namespace brdf::service {

const RecordedError* MaterialVersion::error(int refinements, EvalLevel level) const noexcept {
  const auto found = std::find_if(info.errors.begin(), info.errors.end(), [&](const RecordedError& e) {
    return e.refinement == refinements && e.level == level;
  });
  return found == info.errors.end() ? nullptr : &*found;
}

std::uint64_t MaterialVersion::cut_at(std::uint64_t prefix_bytes) const {
  if (prefix_bytes == 0 || prefix_bytes >= bytes.size()) return bytes.size();
  if (std::find(boundaries.begin(), boundaries.end(), prefix_bytes) == boundaries.end()) {
    std::string allowed;
    for (const std::uint64_t end : boundaries) allowed += (allowed.empty() ? "" : ", ") + std::to_string(end);
    throw FieldError("prefix_bytes", "is " + std::to_string(prefix_bytes) + ", but refinements of " + id + " end at " + allowed);
  }
  return prefix_bytes;
}

int MaterialVersion::refinements_in(std::uint64_t prefix_bytes) const noexcept {
  const auto within = std::count_if(boundaries.begin(), boundaries.end(), [prefix_bytes](std::uint64_t end) { return end <= prefix_bytes; });
  return std::max(static_cast<int>(within) - 1, 0);
}

VersionHandle verify_version(std::string id, std::vector<std::byte> bytes) {
  auto version = std::make_shared<MaterialVersion>();
  version->version = version_of(bytes);
  version->boundaries = refinement_boundaries(bytes);
  DecodeOptions options;
  options.sampling = false;
  const Material material = Material::decode(bytes, options);
  version->info = material.info();
  version->descriptor = describe(material);
  version->id = std::move(id);
  version->bytes = std::move(bytes);
  return version;
}

}  // namespace brdf::service
