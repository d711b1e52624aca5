// SPDX-License-Identifier: Apache-2.0
// Bytes or lobes to a Material, and a Material to another evaluation level.
#include "container/content.h"
#include "decode/memory_need.h"
#include "decode/resample_slices.h"
#include "eval/material_impl.h"
#include "residual/reconstruct.h"
#include "sample/build_density.h"

#include <brdf/error.h>
#include <brdf/material.h>

#include <memory>
#include <string>
#include <utility>

namespace brdf {
namespace {

/// What prepare() needs to build the tables of any level.
struct Source {
  residual::Coefficients coefficients;
  DecodeLimits limits;
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

Material with_sampling(std::shared_ptr<const Material::Impl> impl, bool sampling) {
  auto tables = sampling ? sample::build_density(impl->lobes, impl->tables) : nullptr;
  return Material(std::move(impl), std::move(tables));
}

}  // namespace

Material Material::decode(std::span<const std::byte> bytes, const DecodeOptions& options) {
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
  source->reading_bytes = file.temporary_bytes;
  content.residual = {};  // its numbers are in the coefficients now
  eval::Residual residual = residual_for(*source, content.lobes, options.level);
  auto impl = eval::make_impl(std::move(info), std::move(content.lobes), std::move(residual), options.level);
  impl->source = std::move(source);
  return with_sampling(std::move(impl), options.sampling);
}

std::vector<std::uint64_t> refinement_boundaries(std::span<const std::byte> bytes, const DecodeLimits& limits) {
  return container::boundaries(bytes, limits);
}

Material Material::prepare(EvalLevel level) const { return prepare(level, sampling()); }

Material Material::prepare(EvalLevel level, bool sampling) const {
  if (level == this->level()) {
    if (sampling == this->sampling()) return *this;
    return with_sampling(impl_, sampling);
  }
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
