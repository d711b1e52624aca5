// SPDX-License-Identifier: Apache-2.0
// Files of earlier versions stay readable for ever: what data/golden holds must decode to what it decoded to when it
// was written. Files are added, never replaced. New ones: BRDF_GOLDEN_WRITE=data/golden brdf_golden_tests
#include "container/chunk_types.h"
#include "container/header.h"
#include "golden/make_golden.h"
#include "support/data_folders.h"
#include "support/direct_basis.h"
#include "support/small_measurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace brdf::golden {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

std::vector<fs::path> golden_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(test::source_folder() / "data" / "golden"))
    if (entry.path().extension() == ".brdfc") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Relative error that another compiler or mathematics library may bring. A node's half float may round the other way.
double tolerance(const std::string& level, bool in_slices) {
  return level == "fast" ? 2e-5 : level == "direct" ? (in_slices ? 1e-4 : 1e-6) : 1e-3;
}

TEST(Golden, EveryFileIsThere) {
  std::vector<std::string> names;
  for (const fs::path& file : golden_files()) names.push_back(file.stem().string());
  for (const char* name : {"rgb-lobes", "rgb-reciprocal-layers", "scalar-one-way", "spectral-restart", "rgb-slices", "rgb-mirror-asymmetric",
                           "rgb-coded-lobes", "spectral-coded-lobes", "rgb-stored-cdf", "model-lambert", "model-ggx",
                           "model-anisotropic", "model-compensated", "model-mirror", "model-dielectric"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST(Golden, FilesDecodeToTheExpectedValues) {
  for (const fs::path& file : golden_files()) {
    const auto bytes = bytes_of(read_text(file));
    const auto rows = from_text(read_text(fs::path(file).replace_extension(".txt")));
    const container::Unpacked unpacked = container::unpack(bytes, {}, false);
    const auto refinements = unpacked.refinements_total;
    const bool in_slices = unpacked.content.component.axes == container::AxesKind::slices;
    const std::size_t densities = unpacked.content.sampling.empty() ? 0 : 12;
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(refinements + 1) * 4 * 12 + densities) << file;
    auto found = rows;
    evaluate(bytes, found);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Expectation& row = rows[i];
      const std::vector<double>& f = found[i].f;
      ASSERT_EQ(f.size(), row.f.size()) << file;
      for (std::size_t c = 0; c < f.size(); ++c)
        EXPECT_NEAR(f[c], row.f[c], tolerance(row.level, in_slices) * row.f[c] + 1e-7)
            << file.filename() << " " << row.level << " after " << row.refinements << ", theta_i "
            << std::acos(row.wi.z) << ", theta_o " << std::acos(row.wo.z);
    }
  }
}

TEST(Golden, TablesApproximateTheBasis) {
  for (const fs::path& file : golden_files()) {
    const auto rows = from_text(read_text(fs::path(file).replace_extension(".txt")));
    const auto find = [&](const Expectation& like, const char* level) {
      return std::find_if(rows.begin(), rows.end(), [&](const Expectation& r) {
        return r.level == level && r.refinements == like.refinements && r.wi == like.wi && r.wo == like.wo;
      });
    };
    const bool in_slices = container::unpack(bytes_of(read_text(file)), {}, false).content.component.axes == container::AxesKind::slices;
    for (const Expectation& row : rows) {
      if (row.level != "direct") continue;
      // coefficients in slices know no pole: where the half vector is the normal its azimuth decides, and it has none
      if (in_slices && std::hypot(row.wi.x + row.wo.x, row.wi.y + row.wo.y) < 1e-4F) continue;
      const auto exact = find(row, "exact"), balanced = find(row, "balanced");
      ASSERT_NE(exact, rows.end());
      ASSERT_NE(balanced, rows.end());
      for (std::size_t c = 0; c < row.f.size(); ++c) {
        EXPECT_NEAR(exact->f[c], row.f[c], 0.01 * row.f[c]) << file.filename();
        EXPECT_NEAR(balanced->f[c], row.f[c], 0.03 * row.f[c]) << file.filename();
      }
    }
  }
}

// Files with packed lobes become shorter and say the same.
TEST(Golden, PackingAgainGivesTheSameBytes) {
  for (const fs::path& file : golden_files()) {
    const auto bytes = bytes_of(read_text(file));
    const auto again = container::pack(container::unpack(bytes, {}, false).content);
    const bool packed = container::read_header(bytes, {}).directory.front().code == static_cast<std::uint8_t>(container::ChunkType::packed_lobes);
    if (packed) {
      EXPECT_LT(again.size(), bytes.size()) << file;
      EXPECT_EQ(container::pack(container::unpack(again, {}, false).content), again) << file;
    } else {
      EXPECT_EQ(again, bytes) << file;
    }
    EXPECT_EQ(to_text(expectations(again)), to_text(expectations(bytes))) << file;
  }
}

TEST(Golden, FilesSayWhatTheySaid) {
  const auto info = [](const char* name) {
    const auto file = test::source_folder() / "data" / "golden" / (std::string(name) + ".brdfc");
    return Material::decode(bytes_of(read_text(file))).info();
  };
  const MaterialInfo layers = info("rgb-reciprocal-layers");
  EXPECT_TRUE(layers.reciprocal);
  EXPECT_EQ(layers.refinements_total, 3);
  EXPECT_EQ(layers.provenance.name, "formula");
  EXPECT_EQ(layers.provenance.licence, "CC0");
  EXPECT_EQ(layers.provenance.content_hash, 42U);
  EXPECT_EQ(layers.provenance.file_bytes, 1234U);
  EXPECT_EQ(layers.fitter, "libbrdf golden files");
  ASSERT_EQ(layers.errors.size(), 7U);
  EXPECT_EQ(layers.errors[0].log_mae, 1.0 / 64);
  EXPECT_EQ(layers.errors[0].psnr_env, 30.25);
  EXPECT_EQ(layers.errors[6].log_mae, 1.0 / 512);
  EXPECT_EQ(layers.errors[6].psnr_env, 42.25);
  const MaterialInfo one_way = info("scalar-one-way");
  EXPECT_FALSE(one_way.reciprocal);
  EXPECT_TRUE(one_way.mirror_symmetric);
  EXPECT_TRUE(info("rgb-mirror-asymmetric").reciprocal);
  EXPECT_FALSE(info("rgb-mirror-asymmetric").mirror_symmetric);
  EXPECT_EQ(one_way.channels.model, ChannelModel::scalar);
  EXPECT_EQ(info("spectral-restart").channels.wavelengths_nm, (std::vector<float>{400, 475, 550, 625}));
  EXPECT_EQ(info("rgb-lobes").refinements_total, 0);
}

// The generator is code like any other: what it makes today must decode, whether or not it is written.
TEST(GoldenGenerator, MakesSoundFiles) {
  const char* folder = std::getenv("BRDF_GOLDEN_WRITE");
  const Measurement source = golden_source();
  const MeasurementInterpolator reference(source);
  for (const auto& [name, content] : make_contents()) {
    const auto bytes = container::pack(content);
    EXPECT_LT(bytes.size(), content.sampling.empty() ? 2048U : 6144U) << name;
    const auto rows = expectations(bytes);
    EXPECT_EQ(to_text(from_text(to_text(rows))), to_text(rows)) << name;
    for (const Expectation& row : rows)
      for (const double v : row.f) ASSERT_TRUE(std::isfinite(v) && v >= 0) << name;
    if (name == "rgb-reciprocal-layers") {
      double error = 0, coarse_error = 0;
      std::vector<double> f(3);
      for (const Expectation& row : rows) {
        if (row.level != "direct" || row.wi.z < 0.2F || row.wo.z < 0.2F ||
            !reference.eval(Vec3d(row.wi), Vec3d(row.wo), f))
          continue;
        double& sum = row.refinements == 3 ? error : coarse_error;
        for (std::size_t c = 0; c < 3; ++c)
          if (row.refinements == 3 || row.refinements == 0) sum += std::abs(std::log(row.f[c] / f[c]));
      }
      EXPECT_LT(error, 0.5 * coarse_error) << "the residual must come nearer to its source than the lobes";
    }
    if (folder == nullptr) continue;
    const fs::path file = fs::path(folder) / (name + ".brdfc");
    ASSERT_FALSE(fs::exists(file)) << file << ": golden files are never replaced";
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    std::ofstream(fs::path(file).replace_extension(".txt")) << to_text(rows);
  }
}

}  // namespace
}  // namespace brdf::golden
