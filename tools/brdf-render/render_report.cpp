// SPDX-License-Identifier: Apache-2.0
#include "render_report.h"

#include <brdf/version.h>

#include "image/luminance.h"

#include <cmath>
#include <cstdio>

namespace brdf::cli {
namespace {

using namespace brdf::render;

/// Mean luminance, and the standard error of a pixel relative to it (root mean square over pixels).
std::pair<double, double> noise(const Film& film) {
  double mean = 0, variance = 0;
  const Image image = film.image();
  for (const Vec3f& p : image.pixels) mean += static_cast<double>(luminance(p));
  for (const double v : film.variance()) variance += v;
  const double pixels = static_cast<double>(image.pixels.size());
  mean /= pixels;
  return {mean, mean > 0 ? std::sqrt(variance / pixels) / mean : 0.0};
}

}  // namespace

Metadata picture_metadata(const Scene& scene, const RenderOptions& options, const RenderResult& result, const std::string& command_line) {
  Metadata m;
  m["software"] = std::string("brdf-render ") + version();
  m["brdfScene"] = scene.description.file.string();
  m["brdfCommand"] = command_line;
  m["brdfSampling"] = std::string(to_string(options.sampling));
  m["brdfSeed"] = std::to_string(options.seed);
  m["brdfSamplesPerPixel"] = static_cast<float>(result.film.fewest_samples());
  m["brdfComplete"] = std::string(result.complete ? "yes" : "no");
  m["brdfSeconds"] = static_cast<float>(result.seconds);
  std::string materials;
  for (const MaterialSlot& slot : scene.materials) {
    if (slot.used) materials += (materials.empty() ? "" : "\n") + slot.name + "=" + slot.source;
  }
  m["brdfMaterials"] = materials;
  return m;
}

Json render_row(const Scene& scene, const RenderOptions& options, const RenderResult& result, double load_seconds) {
  const auto [mean, error] = noise(result.film);
  Json row;
  row["scene"] = scene.description.file.string();
  row["width"] = result.film.width();
  row["height"] = result.film.height();
  row["spp"] = result.film.fewest_samples();
  row["complete"] = result.complete;
  row["sampling"] = to_string(options.sampling);
  row["seed"] = options.seed;
  row["threads"] = result.threads;
  row["triangles"] = scene.geometry.triangles();
  row["load_seconds"] = load_seconds;
  row["seconds"] = result.seconds;
  row["processor_seconds"] = result.processor_seconds;
  row["paths"] = result.counts.paths;
  row["vertices"] = result.counts.vertices;
  row["rays"] = result.counts.rays;
  row["shadow_rays"] = result.counts.shadow_rays;
  row["ns_per_vertex"] = result.ns_per_vertex();
  row["rays_per_second"] = result.rays_per_second();
  row["mean_luminance"] = mean;
  row["relative_standard_error"] = error;
  row["materials"] = Json::array();
  for (const MaterialSlot& slot : scene.materials) {
    if (slot.used) row["materials"].push_back({{"slot", slot.name}, {"source", slot.source}, {"bytes", slot.bytes}});
  }
  return row;
}

std::string render_text(const Json& row, const std::string& output) {
  char text[512];
  std::snprintf(text, sizeof text,
                "%s: %d x %d, %u samples per pixel%s, %.2f s (loading %.2f s), noise %.2f %%\n"
                "%.0f ns per path vertex and thread, %.2f million rays/s on %d threads",
                output.c_str(), row["width"].get<int>(), row["height"].get<int>(), row["spp"].get<unsigned>(),
                row["complete"].get<bool>() ? "" : " (interrupted)", row["seconds"].get<double>(), row["load_seconds"].get<double>(),
                100 * row["relative_standard_error"].get<double>(), row["ns_per_vertex"].get<double>(),
                row["rays_per_second"].get<double>() * 1e-6, row["threads"].get<int>());
  return text;
}

}  // namespace brdf::cli
