// SPDX-License-Identifier: Apache-2.0
#include "container/validate_content.h"

#include "analytic/model_check.h"
#include "container/slice_frame_codes.h"
#include "residual/reconstruct.h"

#include <brdf/error.h>

#include <cmath>
#include <string>

namespace brdf::container {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::invalid_argument, "pack: " + what); }

void require(bool ok, const char* what) {
  if (!ok) refuse(what);
}

void validate_lobes(const LobeSet& set, int channels) {
  if (set.channels != channels) refuse("the lobes have " + std::to_string(set.channels) + " channels, the component " + std::to_string(channels));
  for (const Lobe& lobe : set.lobes) {
    if (lobe.color.size() != static_cast<std::size_t>(channels)) refuse("a lobe has " + std::to_string(lobe.color.size()) + " colours");
    require(std::isfinite(lobe.alpha) && lobe.alpha > 0 && lobe.alpha <= 1, "a lobe's alpha is not in (0, 1]");
    require(std::isfinite(lobe.f90) && lobe.f90 >= 0, "a lobe's f90 is not a number of at least 0");
    for (const double c : lobe.color) require(std::isfinite(c) && c >= 0, "a lobe's colour is not a number of at least 0");
  }
}

void validate_residual(const residual::ResidualCode& code, const Component& component) {
  const auto channels = static_cast<std::size_t>(component.channels.count);
  const residual::BasisCodes& b = code.basis;
  require(code.channels == component.channels.count && code.azimuth == azimuth_of(component),
          "residual and component differ in channels or symmetries");
  require(b.kappa_h < 32 && b.kappa_d < 16 && b.window_h < 16 && b.window_d < 16 && b.shape < residual::order_shape_count && b.table < residual::balanced_grid_count &&
              b.epsilon <= residual::largest_epsilon_code, "a basis code is out of range");
  const char* why = "";
  if (!code.slices.empty() && !is_valid(code.slices, why)) refuse(std::string("slice frame: ") + why);
  require(code.slices.empty() || code.azimuth == residual::Azimuth::one_way, "a residual in slices of theta_i cannot be reciprocal");
  const residual::Layer* before = nullptr;
  for (const residual::Layer& layer : code.layers) {
    require(layer.end.size() == channels && layer.q.size() == channels, "a layer does not have one entry per channel");
    for (std::size_t c = 0; c < channels; ++c) {
      const std::uint32_t begin = residual::layer_begin(before, layer, c);
      require(layer.end[c] >= begin && layer.end[c] <= residual::max_coefficients && layer.q[c].size() == layer.end[c] - begin,
              "the ends of a layer do not fit its coefficients");
      for (const std::int32_t q : layer.q[c]) require(q >= -residual::max_magnitude && q <= residual::max_magnitude, "a coefficient is too large");
    }
    before = &layer;
  }
}

void validate_analytic(const Content& content) {
  const Component& c = content.component;
  if (const auto problem = analytic::problem_of(*content.analytic)) refuse(*problem);
  require(analytic::channels_of(*content.analytic) == c.channels.count, "the analytic model and the component differ in channels");
  require(content.lobes.lobes.empty() && content.residual.empty() && content.sampling.empty(), "an analytic model has no lobes or tables");
  require(c.transform == residual::ChannelTransform::identity && c.mirror_symmetric && c.reciprocal == analytic::is_reciprocal(*content.analytic),
          "the component does not say what its analytic model is");
}

}  // namespace

void validate(const Content& content) {
  const Channels& ch = content.component.channels;
  require(ch.count >= 1, "no channels");
  if (ch.model == ChannelModel::rgb || ch.model == ChannelModel::xyz) require(ch.count == 3, "RGB and XYZ have three channels");
  if (ch.model == ChannelModel::scalar) require(ch.count == 1, "a scalar material has one channel");
  if (ch.model == ChannelModel::spectral) require(ch.wavelengths_nm.size() == static_cast<std::size_t>(ch.count), "every spectral channel needs a wavelength");
  require(static_cast<std::uint32_t>(ch.count) <= DecodeLimits{}.max_channels, "more channels than decoders accept");
  for (std::size_t i = 0; i < ch.wavelengths_nm.size(); ++i)
    require(ch.wavelengths_nm[i] > (i == 0 ? 0.0F : ch.wavelengths_nm[i - 1]) && ch.wavelengths_nm[i] < 1e7F,
            "wavelengths are not ascending, or not below 1e7 nm");
  require(content.lobes.lobes.size() <= 15, "a file holds at most 15 lobes");
  validate_lobes(content.lobes, ch.count);
  if (content.analytic) validate_analytic(content);
  if (!content.residual.empty()) validate_residual(content.residual, content.component);
}

}  // namespace brdf::container
