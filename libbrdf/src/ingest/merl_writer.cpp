// SPDX-License-Identifier: Apache-2.0
#include "ingest/merl_writer.h"

#include <brdf/error.h>

#include "base/byte_reader.h"
#include "ingest/half_difference_grid.h"
#include "ingest/merl_layout.h"

#include <array>
#include <cmath>
#include <string>

namespace brdf::ingest {
namespace {

/// The file with every cell invalid; cells are filled in by number.
class MerlImage {
 public:
  MerlImage(const std::array<std::int32_t, 3>& n, std::size_t cells)
      : cells_(cells), bytes_(static_cast<std::size_t>(MerlLayout::file_bytes(cells))) {
    for (std::size_t i = 0; i < n.size(); ++i) base::store_little_endian(n[i], std::span(bytes_).subspan(4 * i, 4));
    for (std::size_t i = 0; i < cells * MerlLayout::channels; ++i) store(i, MerlLayout::invalid);
  }

  /// f in 1/sr.
  void set(std::size_t cell, std::span<const double, 3> f) {
    for (std::size_t c = 0; c < f.size(); ++c) store(c * cells_ + cell, f[c] / MerlLayout::scale[c]);
  }

  std::vector<std::byte> release() { return std::move(bytes_); }

 private:
  void store(std::size_t index, double raw) {
    base::store_little_endian(raw, std::span(bytes_).subspan(MerlLayout::header_bytes + 8 * index, 8));
  }

  std::size_t cells_;
  std::vector<std::byte> bytes_;
};

bool can_be_stored(std::span<const double, 3> f) noexcept {
  for (const double v : f) {
    if (!(v >= 0) || !std::isfinite(v)) return false;
  }
  return true;
}

Error bad_table(const std::string& what) { return {ErrorCode::invalid_argument, "MERL table to write: " + what}; }

void check_table(const HalfDifferenceTable& t) {
  const std::array<std::int32_t, 3> n = {t.n_theta_h, t.n_theta_d, t.n_phi_d};
  if (!MerlLayout::dimensions_fit(n) || t.full_circle != (t.n_phi_d == 360)) {
    throw bad_table("bin counts are " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                    std::to_string(n[2]) + (t.full_circle ? " over 2 pi" : " over pi") +
                    ", allowed are 90 x 90 x 180 over pi and 90 x 90 x 360 over 2 pi");
  }
  const std::size_t cells = HalfDifferenceGrid(t).cells();
  if (t.valid.size() != cells || t.values.size() != cells * MerlLayout::channels) {
    throw bad_table(std::to_string(t.values.size()) + " values and " + std::to_string(t.valid.size()) +
                    " mask entries, needed are three values and one entry for each of " + std::to_string(cells) +
                    " cells");
  }
}

}  // namespace

std::vector<std::byte> write_merl(const HalfDifferenceTable& table) {
  check_table(table);
  MerlImage image({table.n_theta_h, table.n_theta_d, table.n_phi_d}, table.valid.size());
  for (std::size_t cell = 0; cell < table.valid.size(); ++cell) {
    if (table.valid[cell] == 0) continue;
    const float* v = table.values.data() + cell * MerlLayout::channels;
    const std::array<double, 3> f = {v[0], v[1], v[2]};
    if (!can_be_stored(f)) {
      throw bad_table("valid cell " + std::to_string(cell) + " holds " + std::to_string(f[0]) + ", " +
                      std::to_string(f[1]) + ", " + std::to_string(f[2]) + "; values must be finite and at least 0");
    }
    image.set(cell, f);
  }
  return image.release();
}

std::vector<std::byte> write_merl(const RgbFunction& f, SamplePosition position, bool full_circle) {
  HalfDifferenceTable shape;
  shape.n_theta_h = 90;
  shape.n_theta_d = 90;
  shape.n_phi_d = full_circle ? 360 : 180;
  shape.full_circle = full_circle;
  shape.position = position;
  const HalfDifferenceGrid grid(shape);
  MerlImage image({shape.n_theta_h, shape.n_theta_d, shape.n_phi_d}, grid.cells());
  grid.for_each_cell([&](std::size_t cell, const Vec3d& wi, const Vec3d& wo) {
    if (!above_horizon(wi, wo)) return;
    std::array<double, 3> value{};
    if (f(wi, wo, value) && can_be_stored(value)) image.set(cell, value);
  });
  return image.release();
}

}  // namespace brdf::ingest
