// SPDX-License-Identifier: Apache-2.0
// Bad RGL tensor files. Each starts from a sound one and breaks one thing.
#include <brdf/ingest.h>

#include "support/expect_error.h"
#include "support/tensor_file_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brdf {
namespace {

using test::expect_error;
using test::small_rgl_material;

void expect_refused(ErrorCode code, std::initializer_list<const char*> words, const std::vector<std::byte>& bytes,
                    const IngestOptions& options = {}) {
  expect_error(code, words, [&] { read_measurement(bytes, "bad_rgb.bsdf", options); });
}
void expect_refused(ErrorCode code, std::initializer_list<const char*> words, const test::TensorFileBuilder& file,
                    const IngestOptions& options = {}) {
  expect_refused(code, words, file.build(), options);
}

TEST(BadTensorFile, EveryShorterFileIsRefused) {
  const auto whole = small_rgl_material().build();
  read_measurement(whole, "whole");
  for (std::size_t size = 12; size < whole.size(); ++size) {
    const std::vector<std::byte> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    expect_refused(ErrorCode::truncated, {"bad_rgb.bsdf", "the file"}, part);
  }
}

TEST(BadTensorFile, UnknownVersion) {
  auto file = small_rgl_material();
  file.major = 2;
  expect_refused(ErrorCode::unsupported, {"version 2.0", "1.0"}, file);
}

TEST(BadTensorFile, MoreFieldsStatedThanPresent) {
  auto file = small_rgl_material();
  file.stated_count = 200;
  expect_error(ErrorCode::truncated, {"bad"}, [&] {
    // the bytes of the data are then taken for fields; a run-away name length ends it
    auto bytes = file.build();
    bytes.resize(18);
    read_measurement(bytes, "bad");
  });
}

TEST(BadTensorFile, MoreFieldsThanTheLimit) {
  auto file = small_rgl_material();
  file.stated_count = 0xffffffffu;
  expect_refused(ErrorCode::limit_exceeded, {"4294967295 fields", "limit is 256"}, file);
}

TEST(BadTensorFile, FieldBeyondTheEnd) {
  auto file = small_rgl_material();
  file.field("ndf").stated_offset = file.build().size() - 15;
  expect_refused(ErrorCode::truncated, {"'ndf'", "needs 16 bytes"}, file);
}

TEST(BadTensorFile, OffsetThatWrapsAround) {
  auto file = small_rgl_material();
  file.field("sigma").stated_offset = std::numeric_limits<std::uint64_t>::max() - 7;
  expect_refused(ErrorCode::truncated, {"'sigma'", "18446744073709551608"}, file);
}

TEST(BadTensorFile, ShapeWhoseProductWrapsAround) {
  auto file = small_rgl_material();
  file.field("ndf").shape = {std::uint64_t{1} << 32, std::uint64_t{1} << 32};
  expect_refused(ErrorCode::malformed, {"'ndf'", "4294967296 x 4294967296", "64 bits"}, file);
  file.field("ndf").shape = {std::uint64_t{1} << 62, 1};  // the product fits, times four bytes it does not
  expect_refused(ErrorCode::malformed, {"'ndf'", "64 bits"}, file);
}

TEST(BadTensorFile, HugeShape) {
  auto file = small_rgl_material();
  file.field("vndf").shape = {1, 2, 1u << 20, 1u << 20};
  expect_refused(ErrorCode::truncated, {"'vndf'", "8796093022208 bytes"}, file);
}

TEST(BadTensorFile, TooManyDimensions) {
  auto file = small_rgl_material();
  file.field("ndf").shape.assign(17, 1);
  expect_refused(ErrorCode::malformed, {"'ndf'", "17 dimensions"}, file);
}

TEST(BadTensorFile, UnknownElementType) {
  for (const std::uint8_t type : {std::uint8_t{0}, std::uint8_t{12}, std::uint8_t{255}}) {
    auto file = small_rgl_material();
    file.field("ndf").type = type;
    expect_refused(ErrorCode::malformed, {"'ndf'", "element type"}, file);
  }
}

TEST(BadTensorFile, FieldTwice) {
  auto file = small_rgl_material();
  file.floats("ndf", {2, 2}, {1, 1, 1, 1});
  expect_refused(ErrorCode::malformed, {"'ndf'", "twice"}, file);
}

TEST(BadTensorFile, NamesInMessagesArePrintable) {
  auto file = small_rgl_material();
  file.field("ndf").name = "\x1b[2J" + std::string(60000, 'x');
  expect_refused(ErrorCode::malformed, {"'ndf' is missing"}, file);
  auto twice = small_rgl_material();
  twice.floats("\x1b[2J", {1}, {1}).floats("\x1b[2J", {1}, {1});
  expect_refused(ErrorCode::malformed, {"'?[2J'"}, twice);
}

TEST(BadRgl, MissingFields) {
  for (const char* name : {"phi_i", "theta_i", "sigma", "ndf", "vndf", "rgb"}) {
    auto file = small_rgl_material();
    file.remove(name);
    expect_refused(ErrorCode::malformed, {name}, file);
  }
}

TEST(BadRgl, FieldOfAnotherType) {
  auto file = small_rgl_material();
  file.field("rgb").type = 9;  // f16
  expect_refused(ErrorCode::malformed, {"'rgb'", "f16", "f32"}, file);
}

TEST(BadRgl, FieldWithAnotherNumberOfDimensions) {
  auto file = small_rgl_material();
  file.field("rgb").shape = {2, 3, 3, 3};
  expect_refused(ErrorCode::malformed, {"'rgb'", "4 dimensions", "expected 5"}, file);
  file = small_rgl_material();
  file.field("theta_i").shape = {1, 2};
  expect_refused(ErrorCode::malformed, {"'theta_i'", "2 dimensions"}, file);
}

TEST(BadRgl, ShapesThatContradictEachOther) {
  auto file = small_rgl_material();
  file.set_floats("theta_i", {3}, {0, 0.5, 1});
  expect_refused(ErrorCode::malformed, {"'vndf'", "1 x 2 x 2 x 2", "'theta_i'", "must be 3"}, file);
  file = small_rgl_material();
  file.set_floats("rgb", {1, 2, 1, 3, 3}, std::vector<float>(18, 1.0f));
  expect_refused(ErrorCode::malformed, {"'rgb'", "channels", "must be 3"}, file);
  file = small_rgl_material();
  file.set_floats("phi_i", {2}, {0, 1});
  expect_refused(ErrorCode::malformed, {"'vndf'", "'phi_i'", "must be 2"}, file);
}

TEST(BadRgl, TablesThatAreTooSmall) {
  for (const char* name : {"ndf", "sigma"}) {
    auto file = small_rgl_material();
    file.set_floats(name, {1, 2}, {1, 1});
    expect_refused(ErrorCode::malformed, {name, "1 x 2", "2 to"}, file);
    file.set_floats(name, {2, 0}, {});
    expect_refused(ErrorCode::malformed, {name, "2 x 0"}, file);
  }
  auto file = small_rgl_material();
  file.set_floats("rgb", {1, 2, 3, 1, 1}, std::vector<float>(6, 1.0f));
  expect_refused(ErrorCode::malformed, {"'rgb'", "1 x 2 x 3 x 1 x 1"}, file);
}

TEST(BadRgl, NoElevationOrAzimuth) {
  auto file = small_rgl_material();
  file.set_floats("theta_i", {0}, {});
  expect_refused(ErrorCode::malformed, {"'theta_i'", "empty"}, file);
  file = small_rgl_material();
  file.set_floats("phi_i", {0}, {});
  expect_refused(ErrorCode::malformed, {"'phi_i'", "empty"}, file);
}

TEST(BadRgl, ElevationsThatDoNotAscend) {
  auto file = small_rgl_material();
  file.set_floats("theta_i", {2}, {0.5f, 0.5f});
  expect_refused(ErrorCode::malformed, {"'theta_i'", "does not ascend", "index 1"}, file);
}

TEST(BadRgl, ElevationsOutsideTheHemisphere) {
  auto file = small_rgl_material();
  file.set_floats("theta_i", {2}, {-0.1f, 0.5f});
  expect_refused(ErrorCode::malformed, {"'theta_i'", "-0.1", "index 0"}, file);
  file.set_floats("theta_i", {2}, {0, 90});
  expect_refused(ErrorCode::malformed, {"'theta_i'", "90", "radians"}, file);
}

TEST(BadRgl, NanAndInfinityAreNamedByIndex) {
  for (const float bad :
       {std::nanf(""), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    auto file = small_rgl_material();
    std::vector<float> values(54, 1.0f);
    values[17] = bad;
    file.set_floats("rgb", {1, 2, 3, 3, 3}, values);
    expect_refused(ErrorCode::malformed, {"'rgb'", "not finite", "index 17 of 54"}, file);
    for (const char* name : {"ndf", "sigma"}) {
      auto other = small_rgl_material();
      other.set_floats(name, {2, 2}, {1, 1, 1, bad});
      expect_refused(ErrorCode::malformed, {name, "not finite", "index 3"}, other);
    }
    auto angles = small_rgl_material();
    angles.set_floats("theta_i", {2}, {0, bad});
    expect_refused(ErrorCode::malformed, {"'theta_i'", "index 1"}, angles);
  }
}

TEST(BadRgl, NegativeDensities) {
  for (const char* name : {"ndf", "sigma"}) {
    auto file = small_rgl_material();
    file.set_floats(name, {2, 2}, {1, -1, 1, 1});
    expect_refused(ErrorCode::malformed, {name, "index 1", "at least 0"}, file);
  }
  auto file = small_rgl_material();
  file.set_floats("vndf", {1, 2, 2, 2}, {1, 1, 1, 1, 1, 1, -0.5, 1});
  expect_refused(ErrorCode::malformed, {"'vndf'", "index 6", "-0.5"}, file);
}

TEST(BadRgl, Anisotropic) {
  auto file = small_rgl_material();
  file.set_floats("phi_i", {8}, std::vector<float>(8, 0.0f));
  expect_refused(ErrorCode::unsupported, {"anisotropic", "8 azimuths"}, file);
}

TEST(BadRgl, Spectral) {
  auto file = small_rgl_material();
  file.remove("rgb");
  file.floats("wavelengths", {195}, std::vector<float>(195, 500.0f));
  file.floats("spectra", {1}, {1});
  expect_refused(ErrorCode::unsupported, {"spectra of 195 wavelengths", "_rgb"}, file);
}

TEST(BadRgl, Polarimetric) {
  test::TensorFileBuilder file;
  file.floats("M", {1}, {1});
  file.add({"wvls", 3, {1}, std::vector<std::byte>(2), std::nullopt});
  expect_refused(ErrorCode::unsupported, {"polarimetric"}, file);
}

TEST(BadRgl, TensorFileOfSomethingElse) {
  test::TensorFileBuilder file;
  file.floats("weights", {1}, {1});
  expect_refused(ErrorCode::malformed, {"without a field 'rgb'"}, file);
}

TEST(BadRgl, LargerThanTheLimits) {
  IngestOptions options;
  options.limits.max_table_values = 53;
  expect_refused(ErrorCode::limit_exceeded, {"'rgb'", "54 values", "limit is 53"}, small_rgl_material(), options);
  options = {};
  constexpr std::uint64_t values = 2 + 4 + 4 + 8 + 2 * 54;  // theta_i, sigma, ndf, vndf, and rgb twice
  options.limits.max_temporary_bytes = 4 * values - 1;
  expect_refused(ErrorCode::limit_exceeded, {"126 values", "limit is 503 bytes"}, small_rgl_material(), options);
  options.limits.max_temporary_bytes = 4 * values;
  EXPECT_NO_THROW(read_measurement(small_rgl_material().build(), "fits", options));
  options = {};
  options.limits.max_fields = 7;
  expect_refused(ErrorCode::limit_exceeded, {"8 fields", "limit is 7"}, small_rgl_material(), options);
}

TEST(BadRgl, NoChangedByteDoesHarm) {
  // Every byte of the directory set to telling values: reads or throws brdf::Error, nothing else, and what reads can be
  // evaluated.
  const auto sound = small_rgl_material().build();
  int refused = 0, read = 0;
  for (std::size_t at = 12; at < sound.size(); ++at) {
    for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
      auto bytes = sound;
      bytes[at] = static_cast<std::byte>(value);
      try {
        const Measurement m = read_measurement(bytes, "changed");
        std::array<double, 3> f{};
        MeasurementInterpolator(m).eval({0, 0.6, 0.8}, {0.6, 0, 0.8}, f);
        ++read;
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(read, 500);
}

}  // namespace
}  // namespace brdf
