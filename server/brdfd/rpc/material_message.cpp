// SPDX-License-Identifier: Apache-2.0
#include "rpc/material_message.h"

#include "shared/material_name.h"

namespace brdf::service {
namespace {

/// Texts of files need not be UTF-8, which a message's must be.
std::string printable(const std::string& text) {
  std::string out = text.substr(0, 4096);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return out;
}

}  // namespace

v1::EvalLevel message_of(EvalLevel level) noexcept {
  switch (level) {
    case EvalLevel::fast: return v1::EVAL_LEVEL_FAST;
    case EvalLevel::balanced: return v1::EVAL_LEVEL_BALANCED;
    case EvalLevel::exact: return v1::EVAL_LEVEL_EXACT;
  }
  return v1::EVAL_LEVEL_UNSPECIFIED;
}

v1::ChannelModel message_of(ChannelModel model) noexcept {
  switch (model) {
    case ChannelModel::rgb: return v1::CHANNEL_MODEL_RGB;
    case ChannelModel::xyz: return v1::CHANNEL_MODEL_XYZ;
    case ChannelModel::spectral: return v1::CHANNEL_MODEL_SPECTRAL;
    case ChannelModel::scalar: return v1::CHANNEL_MODEL_SCALAR;
  }
  return v1::CHANNEL_MODEL_UNSPECIFIED;
}

v1::Fitness fitness_of(const RecordedError& e) noexcept {
  if (e.log_mae <= 0.001 && e.psnr_env >= 50) return v1::FITNESS_MEASUREMENT;
  if (e.psnr_env >= 40) return v1::FITNESS_CLOSE_UP;
  return e.psnr_env >= 30 ? v1::FITNESS_RENDERING : v1::FITNESS_PREVIEW;
}

v1::Fitness fitness_of(const MaterialVersion& version) noexcept {
  const RecordedError* e = version.error(version.info.refinements_total, EvalLevel::balanced);
  return e == nullptr ? v1::FITNESS_UNSPECIFIED : fitness_of(*e);
}

void fill(v1::RecordedError& m, const RecordedError& e) {
  m.set_refinement(e.refinement);
  m.set_level(message_of(e.level));
  m.set_log_mae(e.log_mae);
  m.set_psnr_env(e.psnr_env);
  m.set_fit_for(fitness_of(e));
}

void fill(v1::Material& m, const MaterialVersion& version) {
  const MaterialInfo& info = version.info;
  m.set_name(material_name(version.id));
  m.set_version(version_name(version.id, version.version));
  m.set_bytes(version.bytes.size());
  m.set_format_version(info.format_version);
  m.mutable_channels()->set_model(message_of(info.channels.model));
  m.mutable_channels()->set_count(info.channels.count);
  m.mutable_channels()->mutable_wavelengths_nm()->Add(info.channels.wavelengths_nm.begin(), info.channels.wavelengths_nm.end());
  m.set_reciprocal(info.reciprocal);
  m.set_mirror_symmetric(info.mirror_symmetric);
  for (std::size_t i = 0; i < version.boundaries.size(); ++i) {
    v1::Refinement* r = m.add_refinements();
    r->set_refinement(static_cast<std::int32_t>(i));
    r->set_prefix_bytes(version.boundaries[i]);
  }
  for (const RecordedError& e : info.errors) fill(*m.add_errors(), e);
  m.set_fit_for(fitness_of(version));
  m.mutable_provenance()->set_name(printable(info.provenance.name));
  m.mutable_provenance()->set_format(printable(info.provenance.format));
  m.mutable_provenance()->set_description(printable(info.provenance.description));
  m.mutable_provenance()->set_licence(printable(info.provenance.licence));
  m.mutable_provenance()->set_fitter(printable(info.fitter));
}

}  // namespace brdf::service
