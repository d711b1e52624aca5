// SPDX-License-Identifier: Apache-2.0
#include "analytic/model_check.h"
#include "container/content.h"

#include <brdf/encode.h>
#include <brdf/error.h>
#include <brdf/version.h>

#include <string>

namespace brdf {
namespace {

Channels channels_for(int count, const Channels* given) {
  if (given != nullptr) {
    if (given->count == count) return *given;
    throw Error(ErrorCode::invalid_argument, "pack_analytic: the model has " + std::to_string(count) + " channels, " +
                                                 std::to_string(given->count) + " are described.");
  }
  if (count == 3) return {ChannelModel::rgb, 3, {}};
  if (count == 1) return {ChannelModel::scalar, 1, {}};
  throw Error(ErrorCode::invalid_argument, "pack_analytic: " + std::to_string(count) +
                                               " channels need their wavelengths; without, 1 and 3 are allowed.");
}

}  // namespace

std::vector<std::byte> pack_analytic(const AnalyticModel& model, const Provenance* provenance, const Channels* channels) {
  analytic::check(model);
  container::Content content;
  content.component.channels = channels_for(analytic::channels_of(model), channels);
  content.component.transform = residual::ChannelTransform::identity;
  content.component.reciprocal = analytic::is_reciprocal(model);
  content.lobes.channels = content.component.channels.count;
  content.analytic = model;
  if (provenance != nullptr) {
    content.provenance = *provenance;
    content.fitter = std::string("libbrdf ") + version();
  }
  return container::pack(content);
}

}  // namespace brdf
