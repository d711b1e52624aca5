// SPDX-License-Identifier: Apache-2.0
#include "networks.h"

#include "direction_planes.h"
#include "exit_codes.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <system_error>
#include <variant>

namespace brdf::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> known_files() {
  const char* shared = std::getenv("BRDF_SHARED");
  const fs::path folder = fs::path(shared != nullptr ? shared : "../shared") / "data" / "models";
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".npz" && path.filename().string().starts_with("nbrdf_")) files.push_back(path);
  }
  std::ranges::sort(files);
  if (files.empty()) {
    throw Failure(ExitCode::bad_input,
                  folder.string() + ": holds no nbrdf_*.npz to compare with; --networks FILE names one");
  }
  return files;
}

peers::Azimuth azimuth_of(const Measurement& m) {
  const auto* table = std::get_if<HalfDifferenceTable>(&m.table);
  return table != nullptr && !table->full_circle ? peers::Azimuth::half_circle : peers::Azimuth::full_circle;
}

}  // namespace

Networks Networks::open(const std::vector<fs::path>& files) {
  Networks networks;
  for (const fs::path& path : files.empty() ? known_files() : files) {
    try {
      networks.files_.emplace_back(path);
    } catch (const Error& e) {
      throw Failure(ExitCode::bad_input, e.what());  // io has exit code 1 only when something was to be written
    }
  }
  return networks;
}

peers::NeuralBrdf Networks::find(const Measurement& m) const {
  const std::string& name = m.provenance.name;
  if (m.channels.count != 3) {
    throw Failure(ExitCode::bad_input,
                  name + ": has " + std::to_string(m.channels.count) + " channels, a network has exactly 3");
  }
  for (const peers::NpzFile& file : files_) {
    const std::optional<std::vector<float>> weights = file.floats(name);
    if (!weights) continue;
    try {
      return {*weights, azimuth_of(m)};
    } catch (const Error& e) {
      throw Failure(ExitCode::bad_input, file.path().string() + ": " + name + ": " + e.what());
    }
  }
  throw Failure(ExitCode::bad_input, name + ": has no network of that name to compare with");
}

BatchEval batch_rows(const peers::NeuralBrdf& network) {
  return [network](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    thread_local DirectionPlanes in, view;
    thread_local std::vector<float> values;
    const std::size_t n = wi.size();
    in.assign(wi);
    view.assign(wo);
    values.resize(3 * n);
    network.eval(in.span(), view.span(), {values.data(), n});
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i) out[3 * i + c] = values[c * n + i];
  };
}

}  // namespace brdf::cli
