// SPDX-License-Identifier: Apache-2.0
// Bytes or lobes to a Material, and a Material to another evaluation level.
#include "container/content.h"
#include "container/density_codes.h"
#include "decode/analytic_material.h"
#include "decode/memory_need.h"
#include "decode/resample_slices.h"
#include "decode/sampling_tables.h"
#include "eval/material_impl.h"
#include "residual/reconstruct.h"
#include "sample/build_density.h"
#include "sample/stored_density.h"

#include <brdf/error.h>
#include <brdf/material.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace brdf {
namespace {

/// What prepare() needs to build the tables of any level.
struct Source {
  residual::Coefficients coefficients;
  DecodeLimits limits;
  std::vector<std::byte> sampling;  ///< stored tables, not decoded yet
  std::uint64_t reading_bytes = 0;  ///< that reading the file took
};

eval::Residual residual_for(const Source& source, const LobeSet& lobes, EvalLevel level) {
  const residual::Coefficients& c = source.coefficients;
  if (const auto problem = decode::beyond_limits(decode::memory_need(c, level, source.reading_bytes), level, source.limits)) throw *problem;
  if (level == EvalLevel::fast || c.order.empty()) return {};
  if (c.slices.empty()) return residual::reconstruct(c, decode::grid_size(c, level));
  if (level == EvalLevel::exact) return slices::SliceTable(c);
  return decode::resample_slices(c, lobes, decode::grid_size(c, level));
}

/// What the file says, if that is of this level; null otherwise.
std::shared_ptr<const Material::Sampling> stored_sampling(const Material::Impl& impl) {
  const auto* source = static_cast<const Source*>(impl.source.get());
  if (source == nullptr || source->sampling.empty()) return nullptr;
  static_assert(container::density_views == sample::ComponentTable::views && container::density_rows == sample::ComponentTable::rows_per_view &&
                container::density_heights == sample::row_cells + 1);
  const container::DensityCodes codes = container::read_density(source->sampling);
  if (codes.level != impl.level) return nullptr;
  sample::NodeDensities nodes;
  for (const auto& component : codes.components) {
    std::vector<double>& density = nodes.components.emplace_back();
    density.reserve(component.size());
    for (const std::int16_t code : component) density.push_back(std::exp2(code / container::density_steps));
  }
  for (std::size_t k = 0; k < container::density_views; ++k) nodes.second[k] = codes.second[k] / 255.0;
  return sample::density_from_nodes(impl.lobes, nodes);
}

std::shared_ptr<const Material::Sampling> sampling_of(const Material::Impl& impl) {
  auto tables = stored_sampling(impl);
  return tables ? tables : sample::build_density(impl.lobes, impl.tables, impl.info.mirror_symmetric);
}

Material with_sampling(std::shared_ptr<const Material::Impl> impl, bool sampling) {
  auto tables = sampling ? sampling_of(*impl) : nullptr;
  return Material(std::move(impl), std::move(tables));
}

std::shared_ptr<const Material::Impl> decode_impl(std::span<const std::byte> bytes, const DecodeOptions& options) {
  container::Unpacked file = container::unpack(bytes, options.limits, options.allow_prefix);
  container::Content& content = file.content;
  MaterialInfo info;
  info.bytes = bytes.size();
  info.total_bytes = file.total_bytes;
  info.refinements_read = file.refinements_read;
  info.refinements_total = file.refinements_total;
  info.channels = content.component.channels;
  info.reciprocal = content.component.reciprocal;
  info.mirror_symmetric = content.component.mirror_symmetric;
  info.errors = std::move(content.errors);
  if (content.provenance) info.provenance = std::move(*content.provenance);
  info.fitter = std::move(content.fitter);

  auto source = std::make_shared<Source>();
  source->coefficients = residual::dequantise(content.residual, content.component.transform, content.residual.layers.size());
  source->coefficients.channels = info.channels.count;
  source->limits = options.limits;
  source->sampling = std::move(content.sampling);
  source->reading_bytes = file.temporary_bytes;
  content.residual = {};  // its numbers are in the coefficients now
  eval::Residual residual = residual_for(*source, content.lobes, options.level);
  auto impl = eval::make_impl(std::move(info), std::move(content.lobes), std::move(residual), options.level);
  impl->source = std::move(source);
  return impl;
}

}  // namespace

Material Material::decode(std::span<const std::byte> bytes, const DecodeOptions& options) {
  return with_sampling(decode_impl(bytes, options), options.sampling);
}

std::shared_ptr<const Material::Sampling> decode::sampling_tables(std::span<const std::byte> bytes, const DecodeOptions& options) {
  return sampling_of(*decode_impl(bytes, options));
}

std::vector<std::uint64_t> refinement_boundaries(std::span<const std::byte> bytes, const DecodeLimits& limits) {
  return container::boundaries(bytes, limits);
}

Material Material::prepare(EvalLevel level) const { return prepare(level, sampling()); }

Material Material::prepare(EvalLevel level, bool sampling) const {
  if (level == this->level()) {
    if (sampling == this->sampling() || impl_->model) return *this;
    return with_sampling(impl_, sampling);
  }
  if (impl_->model) return Material(decode::analytic_impl(impl_->info, *impl_->model, level, impl_->scatterer));
  const auto* source = static_cast<const Source*>(impl_->source.get());
  auto impl = eval::make_impl(impl_->info, impl_->lobes, source != nullptr ? residual_for(*source, impl_->lobes, level) : eval::Residual{}, level);
  impl->source = impl_->source;
  return with_sampling(std::move(impl), sampling);
}

Material Material::from_lobes(const LobeSet& lobes) {
  MaterialInfo info;
  info.channels.count = lobes.channels;
  info.channels.model = lobes.channels == 3 ? ChannelModel::rgb : ChannelModel::scalar;
  info.reciprocal = true;
  return with_sampling(eval::make_impl(std::move(info), lobes, {}, EvalLevel::fast), true);
}

}  // namespace brdf
