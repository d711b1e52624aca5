// SPDX-License-Identifier: Apache-2.0
#include "info_report.h"

#include <brdf/check.h>

#include "compressed_file.h"
#include "material_checks.h"

#include <array>
#include <cstdio>

namespace brdf::cli {
namespace {

const char* model_name(ChannelModel model) noexcept {
  switch (model) {
    case ChannelModel::rgb: return "rgb";
    case ChannelModel::xyz: return "xyz";
    case ChannelModel::spectral: return "spectral";
    case ChannelModel::scalar: return "scalar";
  }
  return "unknown";
}

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 17> text;
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

void add_channels(Json& row, const Channels& channels) {
  row["channels"] = channels.count;
  row["channel_model"] = model_name(channels.model);
  row["wavelengths_nm"] = channels.wavelengths_nm;
}

void add_provenance(Json& row, const Provenance& p) {
  row["name"] = p.name;
  row["format"] = p.format;
  row["description"] = p.description;
  row["licence"] = p.licence;
  row["content_hash"] = p.content_hash == 0 ? Json("") : Json(hexadecimal(p.content_hash));
}

Json table_shape(const Measurement& m) {
  if (const auto* t = std::get_if<HalfDifferenceTable>(&m.table)) return {t->n_theta_h, t->n_theta_d, t->n_phi_d};
  const auto& t = std::get<VisibleNormalTable>(m.table);
  return {t.theta_i.size(), t.height, t.width};
}

/// Boundaries and recorded errors of the refinements that the bytes hold; number 0 is the lobes alone.
Json refinements(const MaterialSource& source) {
  const std::vector<std::uint64_t> ends = refinement_ends(source.bytes(), source.path());
  Json list = Json::array();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    Json entry;
    entry["refinement"] = k;
    entry["ends_at"] = ends[k];
    entry["present"] = ends[k] <= source.bytes().size();
    entry["errors"] = Json::array();
    for (const RecordedError& e : source.material().info().errors) {
      if (e.refinement != static_cast<int>(k)) continue;
      Json error;
      error["level"] = to_string(e.level);
      error["log_mae"] = e.log_mae;
      error["psnr_env"] = e.psnr_env;
      entry["errors"].push_back(std::move(error));
    }
    list.push_back(std::move(entry));
  }
  return list;
}

Json lobe_list(const LobeSet& set) {
  Json list = Json::array();
  for (const Lobe& lobe : set.lobes) {
    Json entry;
    entry["kind"] = lobe_name(lobe.kind);
    if (lobe.kind != LobeKind::lambert) {
      entry["alpha"] = lobe.alpha;
      entry["f90"] = lobe.f90;
    }
    entry["color"] = lobe.color;
    list.push_back(std::move(entry));
  }
  return list;
}

/// The parameters of an analytic material, or null.
Json model_row(const AnalyticModel* model) {
  if (model == nullptr) return {};
  Json row;
  row["kind"] = name_of(*model);
  if (const auto* m = std::get_if<Lambert>(model)) row["albedo"] = m->albedo;
  if (const auto* m = std::get_if<Mirror>(model)) row["reflectance"] = m->reflectance;
  if (const auto* m = std::get_if<Dielectric>(model)) row["ior"] = m->ior;
  if (const auto* m = std::get_if<GgxReflector>(model)) {
    row["alpha_x"] = m->alpha_x;
    row["alpha_y"] = m->alpha_y;
    row["f0"] = m->f0;
    row["multiple_scattering"] = m->multiple_scattering;
  }
  return row;
}

}  // namespace

const char* lobe_name(LobeKind kind) noexcept {
  switch (kind) {
    case LobeKind::lambert: return "lambert";
    case LobeKind::ggx: return "ggx";
    case LobeKind::retro_ggx: return "retro_ggx";
  }
  return "unknown";
}

Json measured_info(const MaterialSource& source) {
  const Measurement& m = source.measurement();
  const IngestReport r = report(m);
  Json row;
  row["file"] = source.path();
  row["kind"] = "measured";
  add_provenance(row, m.provenance);
  row["file_bytes"] = source.file_bytes();
  add_channels(row, m.channels);
  row["table"] = table_shape(m);
  row["cells"] = r.cells;
  row["numbers"] = r.numbers;
  row["invalid_fraction"] = r.invalid_fraction;
  row["negative_fraction"] = r.negative_fraction;
  row["reciprocity_asymmetry"] = r.reciprocity_asymmetry;
  row["mirror_asymmetry"] = r.mirror_asymmetry;
  row["max_albedo"] = r.max_albedo;
  row["max_value"] = r.max_value;
  return row;
}

Json compressed_info(const MaterialSource& source) {
  const Material& material = source.material();
  const MaterialInfo& info = material.info();
  Json row;
  row["file"] = source.path();
  row["kind"] = "compressed";
  row["format_version"] = info.format_version;
  add_provenance(row, info.provenance);
  row["fitter"] = info.fitter;
  row["file_bytes"] = source.file_bytes();
  row["bytes_read"] = info.bytes;
  row["total_bytes"] = info.total_bytes;
  add_channels(row, info.channels);
  row["reciprocal"] = info.reciprocal;
  row["mirror_symmetric"] = info.mirror_symmetric;
  row["refinements_read"] = info.refinements_read;
  row["refinements_total"] = info.refinements_total;
  row["refinements"] = refinements(source);
  row["model"] = model_row(material.analytic());
  row["lobes"] = lobe_list(material.lobes());
  const FileCheck check = check_file(source.bytes(), {}, true);
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    // null: the tables are beyond the limits
    row["resident_bytes"][to_string(level)] = check.readable(level) ? Json(material.prepare(level, false).resident_bytes()) : Json();
    row["temporary_bytes"][to_string(level)] = check.at(level).temporary_bytes;
    row["largest_albedo"][to_string(level)] = check.readable(level) ? Json(largest_albedo(material.prepare(level, true)).value) : Json();
  }
  return row;
}

}  // namespace brdf::cli
