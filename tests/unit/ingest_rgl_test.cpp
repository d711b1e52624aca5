// SPDX-License-Identifier: Apache-2.0
// Reading of RGL tensor files.
#include <brdf/ingest.h>

#include "ingest/tensor_file.h"
#include "support/tensor_file_builder.h"

#include <gtest/gtest.h>

namespace brdf {
namespace {

VisibleNormalTable table_of(const test::TensorFileBuilder& file) {
  return std::get<VisibleNormalTable>(read_measurement(file.build(), "m_rgb.bsdf").table);
}

TEST(IngestRgl, ReadsEveryField) {
  const auto bytes = test::small_rgl_material().build();
  const Measurement m = read_measurement(bytes, "some/folder/red-felt_rgb.bsdf");
  EXPECT_EQ(m.provenance.name, "red-felt");
  EXPECT_EQ(m.provenance.format, "RGL");
  EXPECT_EQ(m.provenance.description, "a test");
  EXPECT_EQ(m.provenance.file_bytes, bytes.size());
  EXPECT_EQ(m.channels.model, ChannelModel::rgb);
  EXPECT_EQ(m.channels.count, 3);
  const auto& t = std::get<VisibleNormalTable>(m.table);
  EXPECT_EQ(t.theta_i, (std::vector<float>{0.0f, 1.04719755f}));
  EXPECT_EQ(t.height, 3);
  EXPECT_EQ(t.width, 3);
  EXPECT_EQ(t.vndf_height, 2);
  EXPECT_EQ(t.vndf.size(), 8u);
  EXPECT_EQ(t.ndf.size(), 4u);
  EXPECT_EQ(t.sigma.size(), 4u);
  EXPECT_FALSE(t.jacobian);
}

TEST(IngestRgl, ChannelsBecomeTheLastAxis) {
  const VisibleNormalTable t = table_of(test::small_rgl_material());
  ASSERT_EQ(t.values.size(), 2u * 9u * 3u);
  // elevation 1, row 2, column 0, channel 2
  EXPECT_FLOAT_EQ(t.values[((1 * 3 + 2) * 3 + 0) * 3 + 2], 120.2f);
  EXPECT_FLOAT_EQ(t.values[((0 * 3 + 1) * 3 + 2) * 3 + 0], 12.0f);
}

TEST(IngestRgl, NegativeValuesStayAsTheyAre) {
  auto file = test::small_rgl_material();
  std::vector<float> values(54, 1.0f);
  values[0] = -0.25f;
  file.set_floats("rgb", {1, 2, 3, 3, 3}, values);
  EXPECT_EQ(table_of(file).values[0], -0.25f);
}

TEST(IngestRgl, JacobianIsOnUnlessTheFileSaysZero) {
  auto file = test::small_rgl_material();
  file.field("jacobian").data = {std::byte{1}};
  EXPECT_TRUE(table_of(file).jacobian);
  file.remove("jacobian");
  EXPECT_TRUE(table_of(file).jacobian);
}

TEST(IngestRgl, OfTwoAzimuthsTheFirstIsTaken) {
  auto file = test::small_rgl_material();
  file.set_floats("phi_i", {2}, {0.0f, 3.0f});
  std::vector<float> density(16, 1.0f), values(108, 5.0f);
  std::fill(values.begin() + 54, values.end(), 9.0f);
  std::fill(density.begin() + 8, density.end(), 2.0f);
  file.set_floats("vndf", {2, 2, 2, 2}, density);
  file.set_floats("rgb", {2, 2, 3, 3, 3}, values);
  const VisibleNormalTable t = table_of(file);
  EXPECT_EQ(t.vndf, std::vector<float>(8, 1.0f));
  EXPECT_EQ(t.values, std::vector<float>(54, 5.0f));
}

TEST(IngestRgl, DescriptionIsMadePrintable) {
  auto file = test::small_rgl_material();
  file.remove("description");
  file.text("description", "caf\xc3\xa9 \x1b[31mred\n\xff\xc0\xaf end\0\0");
  const Measurement m = read_measurement(file.build(), "m.bsdf");
  EXPECT_EQ(m.provenance.description, "caf\xc3\xa9  [31mred ??? end");
}

TEST(IngestRgl, FieldsItDoesNotKnowAreIgnored) {
  auto file = test::small_rgl_material();
  file.add({"valid", 1, {4}, std::vector<std::byte>(4), std::nullopt});
  file.add({"scalar", 11, {}, std::vector<std::byte>(8), std::nullopt});
  EXPECT_EQ(table_of(file).values.size(), 54u);
}

TEST(TensorFile, TypesHaveTheSizesOfTheirNames) {
  using ingest::TensorType;
  EXPECT_STREQ(to_string(TensorType::u8), "u8");
  EXPECT_STREQ(to_string(TensorType::f16), "f16");
  EXPECT_STREQ(to_string(TensorType::f64), "f64");
  EXPECT_EQ(bytes_of(TensorType::u16), 2u);
  EXPECT_EQ(bytes_of(TensorType::f32), 4u);
  EXPECT_EQ(bytes_of(TensorType::i64), 8u);
}

}  // namespace
}  // namespace brdf
