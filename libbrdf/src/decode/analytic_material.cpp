// SPDX-License-Identifier: Apache-2.0
#include "decode/analytic_material.h"

#include "analytic/model_check.h"

#include <utility>

namespace brdf {

namespace decode {

std::shared_ptr<Material::Impl> analytic_impl(MaterialInfo info, const AnalyticModel& model, EvalLevel level,
                                              std::shared_ptr<const analytic::Scatterer> scatterer) {
  auto impl = eval::make_impl(std::move(info), analytic::equal_lobes(model), {}, level);
  impl->model = model;
  impl->scatterer = scatterer ? std::move(scatterer) : analytic::make_scatterer(model);
  if (analytic::facets_say_f(model)) impl->facets = std::get_if<analytic::GgxScatter>(impl->scatterer.get());
  return impl;
}

}  // namespace decode

Material Material::from_analytic(const AnalyticModel& model) {
  analytic::check(model);
  MaterialInfo info;
  info.channels.count = analytic::channels_of(model);
  info.channels.model = info.channels.count == 3   ? ChannelModel::rgb
                        : info.channels.count == 1 ? ChannelModel::scalar
                                                   : ChannelModel::spectral;
  info.reciprocal = analytic::is_reciprocal(model);
  return Material(decode::analytic_impl(std::move(info), model, EvalLevel::balanced));
}

}  // namespace brdf
