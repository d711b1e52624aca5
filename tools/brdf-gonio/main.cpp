// SPDX-License-Identifier: Apache-2.0
// brdf-gonio: a simulated gonioreflectometer. Writes MERL-layout tables with the faults of real measurements, so that
// tests and examples need no licensed data.
#include <brdf/error.h>
#include <brdf/measurement.h>
#include <brdf/version.h>

#include "base/file_io.h"
#include "geometry/half_difference.h"
#include "ingest/merl_writer.h"
#include "instrument_noise.h"
#include "layered_surface.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>

namespace {

using namespace brdf;
using namespace brdf::gonio;

constexpr int exit_ok = 0, exit_failed = 1, exit_usage = 2;

struct Options {
  std::filesystem::path out;
  std::string surface{surface_recipes().front().name};
  std::uint64_t seed = 1;
  std::optional<double> noise;
  bool force = false, list = false;
};

const SurfaceRecipe* find_recipe(const std::string& name) {
  const auto all = surface_recipes();
  const auto it = std::find_if(all.begin(), all.end(), [&](const SurfaceRecipe& r) { return r.name == name; });
  return it == all.end() ? nullptr : &*it;
}

HalfDifferenceTable measure(const LayeredSurface& surface, const InstrumentNoise& instrument) {
  HalfDifferenceTable t;
  t.n_theta_h = t.n_theta_d = 90;
  t.n_phi_d = 180;
  const std::size_t cells = 90 * 90 * 180;
  t.values.assign(cells * 3, 0.0f);
  t.valid.assign(cells, 0);
  std::size_t cell = 0;
  for (int i = 0; i < t.n_theta_h; ++i) {
    for (int j = 0; j < t.n_theta_d; ++j) {
      for (int k = 0; k < t.n_phi_d; ++k, ++cell) {
        const double degree = std::numbers::pi / 180, root = i / 90.0;
        Vec3d wi, wo;
        geometry::directions_from_half_difference(root * root * 90 * degree, j * degree, k * degree, wi, wo);
        const double low = std::min(wi.z, wo.z);
        // at the poles phi_d has no meaning: all its cells are one pair of directions, measured once
        const std::size_t pair = i == 0 || j == 0 ? cell - static_cast<std::size_t>(k) : cell;
        if (!(low > 0) || !instrument.measures(pair, low)) continue;
        auto f = surface.eval(wi, wo);
        instrument.disturb(pair, low, f);
        std::transform(f.begin(), f.end(), t.values.begin() + static_cast<std::ptrdiff_t>(cell * 3),
                       [](double v) { return static_cast<float>(v); });
        t.valid[cell] = 1;
      }
    }
  }
  return t;
}

int sample(const Options& o) {
  if (o.list) {
    for (const SurfaceRecipe& r : surface_recipes()) std::cout << r.name << "  " << r.description << '\n';
    return std::cout.flush() ? exit_ok : exit_failed;
  }
  if (o.out.empty()) {
    std::cerr << "brdf-gonio: -o OUT.binary is missing\n";
    return exit_usage;
  }
  const SurfaceRecipe* recipe = find_recipe(o.surface);
  if (!recipe) {
    std::cerr << "brdf-gonio: --surface is " << o.surface << ", allowed are the names of --list\n";
    return exit_usage;
  }
  const double noise = o.noise.value_or(recipe->noise);
  if (!(noise >= 0 && noise <= 1)) {
    std::cerr << "brdf-gonio: --noise is " << noise << ", allowed is 0 to 1\n";
    return exit_usage;
  }
  if (!o.force && std::filesystem::exists(o.out)) {  // said before the work; the writer checks again
    std::cerr << "brdf-gonio: " << o.out.string() << ": file exists, use -f to replace it\n";
    return exit_failed;
  }
  const HalfDifferenceTable table = measure(LayeredSurface(*recipe), InstrumentNoise(o.seed, noise));
  base::write_file_atomically(o.out, ingest::write_merl(table), o.force);
  return exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Simulated gonioreflectometer: measured tables of surfaces that nobody owns.", "brdf-gonio"};
  app.set_version_flag("--version", std::string("brdf-gonio ") + version());
  app.require_subcommand(1);
  Options o;
  auto* verb =
      app.add_subcommand("sample", "Write a MERL-layout table (90 x 90 x 180, bin edges, -1 where not measured)");
  verb->add_option("-o,--output", o.out, "File to write");
  verb->add_option("--surface", o.surface, "Surface, one of --list")->capture_default_str();
  verb->add_option("--seed", o.seed, "Seed of the noise; the same seed gives the same file")->capture_default_str();
  verb->add_option("--noise", o.noise, "Relative standard deviation at normal incidence, 0 to 1 (default: the surface's own)");
  verb->add_flag("--list", o.list, "List the surfaces");
  verb->add_flag("-f,--force", o.force, "Replace an existing file");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? exit_ok : exit_usage;
  }
  try {
    return sample(o);
  } catch (const std::exception& e) {
    std::cerr << "brdf-gonio: " << e.what() << '\n';
    return exit_failed;
  }
}
