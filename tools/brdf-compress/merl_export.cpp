// SPDX-License-Identifier: Apache-2.0
#include "merl_export.h"

#include "exit_codes.h"
#include "ingest/merl_writer.h"

#include <variant>

namespace brdf::cli {

std::vector<std::byte> export_merl(const MaterialSource& source, const MerlExport& wanted) {
  const int channels = source.channels().count;
  if (channels != 3) {
    throw Failure(ExitCode::bad_input,
                  source.path() + ": has " + std::to_string(channels) + " channels, a MERL table holds exactly 3");
  }
  if (!source.is_compressed()) {
    const auto* table = std::get_if<HalfDifferenceTable>(&source.measurement().table);
    if (table != nullptr && table->position == wanted.position && table->full_circle == wanted.full_circle &&
        table->n_theta_h == 90 && table->n_theta_d == 90) {
      return ingest::write_merl(*table);
    }
  }
  return ingest::write_merl(
      [&](const Vec3d& wi, const Vec3d& wo, std::span<double, 3> f) { return source.eval(wi, wo, f); }, wanted.position,
      wanted.full_circle);
}

}  // namespace brdf::cli
