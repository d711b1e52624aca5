// SPDX-License-Identifier: Apache-2.0
#include <brdf/measurement.h>

#include "ingest/half_difference_lookup.h"
#include "ingest/visible_normal_lookup.h"

#include <variant>

namespace brdf {

struct MeasurementInterpolator::State {
  using Lookup = std::variant<ingest::HalfDifferenceLookup, ingest::VisibleNormalLookup>;

  static Lookup make_lookup(const Measurement& m) {
    if (const auto* table = std::get_if<HalfDifferenceTable>(&m.table)) {
      return ingest::HalfDifferenceLookup(*table, m.channels.count);
    }
    return ingest::VisibleNormalLookup(std::get<VisibleNormalTable>(m.table), m.channels.count);
  }

  explicit State(const Measurement& m) : lookup(make_lookup(m)) {}

  Lookup lookup;
};

MeasurementInterpolator::MeasurementInterpolator(const Measurement& m) : state_(std::make_unique<State>(m)) {}
MeasurementInterpolator::~MeasurementInterpolator() = default;
MeasurementInterpolator::MeasurementInterpolator(MeasurementInterpolator&&) noexcept = default;
MeasurementInterpolator& MeasurementInterpolator::operator=(MeasurementInterpolator&&) noexcept = default;

bool MeasurementInterpolator::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept {
  if (const auto* table = std::get_if<ingest::HalfDifferenceLookup>(&state_->lookup)) return table->eval(wi, wo, f);
  return std::get_if<ingest::VisibleNormalLookup>(&state_->lookup)->eval(wi, wo, f);
}

}  // namespace brdf
