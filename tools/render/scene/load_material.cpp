// SPDX-License-Identifier: Apache-2.0
#include "base/file_io.h"
#include "scene/scene.h"
#include "surface/measured_table.h"

#include <brdf/error.h>
#include <brdf/ingest.h>

#include <algorithm>
#include <memory>
#include <system_error>

namespace brdf::render {
namespace {

namespace fs = std::filesystem;

/// A prefix must be one of the lengths at which the file may be cut; the sentence tells which they are.
void check_prefix(std::span<const std::byte> bytes, std::uint64_t prefix, const std::string& name) {
  std::vector<std::uint64_t> allowed = refinement_boundaries(bytes);
  if (std::find(allowed.begin(), allowed.end(), prefix) != allowed.end()) return;
  std::string list;
  for (const std::uint64_t length : allowed) list += (list.empty() ? "" : ", ") + std::to_string(length);
  throw Error(ErrorCode::invalid_argument, name + ": a prefix of " + std::to_string(prefix) + " bytes is no refinement boundary, allowed is " + list);
}

}  // namespace

Surface load_surface(const fs::path& path, const MaterialFile& options, std::uint64_t& bytes) {
  std::vector<std::byte> content = base::read_file(path, IngestLimits{}.max_file_bytes);
  bytes = content.size();
  const std::string name = path.string();
  if (sniff(content, content.size()) != FileFormat::brdfc) {
    if (options.prefix) throw Error(ErrorCode::invalid_argument, name + ": 'prefix' is for .brdfc files");
    IngestOptions ingest;
    ingest.position = options.position;
    Measurement measurement = read_measurement(content, name, ingest);
    return Surface::from_table(std::make_shared<const MeasuredTable>(std::move(measurement), options.incident == IncidentSide::viewer));
  }
  if (options.incident == IncidentSide::viewer) throw Error(ErrorCode::invalid_argument, name + ": 'incident' is for measured files");
  try {
    if (options.prefix) {
      check_prefix(content, *options.prefix, name);
      content.resize(static_cast<std::size_t>(*options.prefix));
      bytes = *options.prefix;
    }
    DecodeOptions decode;
    decode.allow_prefix = options.prefix.has_value();
    decode.level = options.level;
    decode.limits.max_channels = static_cast<std::uint32_t>(MeasuredTable::max_channels);
    return Surface::from_material(Material::decode(content, decode));
  } catch (const Error& e) {
    const std::string what = e.what();
    throw Error(e.code(), what.starts_with(name) ? what : name + ": " + what);
  }
}

fs::path find_material(const MaterialFile& material, const std::vector<fs::path>& folders) {
  std::string tried;
  for (const std::string& file : material.files) {
    if (fs::path(file).is_absolute()) {
      if (std::error_code error; fs::exists(file, error)) return file;
    } else {
      for (const fs::path& folder : folders)
        if (std::error_code error; fs::exists(folder / file, error)) return folder / file;
    }
    tried += (tried.empty() ? "'" : " or '") + file + "'";
  }
  std::string places;
  for (const fs::path& folder : folders) places += (places.empty() ? "" : ", ") + (folder.empty() ? std::string(".") : folder.lexically_normal().string());
  throw Error(ErrorCode::io, tried + " is in none of the folders: " + places);
}

}  // namespace brdf::render
