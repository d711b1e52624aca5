// SPDX-License-Identifier: Apache-2.0
// OBJ and PLY, well formed and not.
#include "shape/obj_reader.h"
#include "shape/ply_reader.h"
#include "shape/ply_writer.h"
#include "support/expect_error.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

namespace brdf::render {
namespace {

using brdf::test::expect_error;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text.data(), text.size())); }

TEST(ObjReader, ReadsPolygonsWithNormalsAndCoordinates) {
  const Mesh m = read_obj("# a square\r\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\no name\nusemtl x\nf 1/1/1 2/2/1 3/3/1 4/4/1\n", "a.obj");
  ASSERT_EQ(m.triangles.size(), 2U);
  ASSERT_EQ(m.positions.size(), 4U);
  ASSERT_EQ(m.normals.size(), 4U);
  ASSERT_EQ(m.uvs.size(), 4U);
  EXPECT_EQ(m.normals[0], Vec3f(0, 0, 1));
  EXPECT_EQ(m.triangles[1], glm::uvec3(0, 2, 3));
  EXPECT_EQ(m.uvs[2], glm::vec2(1, 1));
}

TEST(ObjReader, CountsBackwardsAndSplitsVertices) {
  const Mesh m = read_obj("v 0 0 0\nv +1 0 0\nv 0 1e0 0\nf -3 -2 -1\nvn 0 0 1\nf 1//1 2//1 3//1\n", "a.obj");
  EXPECT_EQ(m.triangles.size(), 2U);
  EXPECT_EQ(m.positions.size(), 6U);   // with and without a normal are two vertices
  EXPECT_TRUE(m.normals.empty());      // since some corners have none
  EXPECT_TRUE(m.uvs.empty());
}

TEST(ObjReader, BadFilesAreRefusedWithTheLine) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::vector<std::pair<std::string, std::vector<const char*>>> cases{
      {three + "f 1 2 4\n", {"a.obj:4", "'4'", "3"}}, {three + "f 0 1 2\n", {"a.obj:4", "'0'"}},     {three + "f -4 1 2\n", {"'-4'"}},
      {three + "f 1 2\n", {"a.obj:4", "3"}},          {three + "f a b c\n", {"'a'"}},               {three + "f 1/1 2/1 3/1\n", {"texture"}},
      {three + "f 1//1 2//1 3//1\n", {"normal"}},     {"v 0 0\nf 1 1 1\n", {"a.obj:1", "finite"}},  {"v 0 0 inf\n", {"a.obj:1", "'inf'"}},
      {"v 0 0 1e99\n", {"a.obj:1"}},                  {"v 0 0 0x\n", {"'0x'"}},                     {three + "f 1 2 99999999999999999999\n", {"a.obj:4"}},
  };
  for (const auto& [text, words] : cases) {
    SCOPED_TRACE(text);
    for (const char* word : words) expect_error(ErrorCode::malformed, {"a.obj", word}, [&t = text] { read_obj(t, "a.obj"); });
  }
  for (const std::string& empty : {std::string(), three, std::string("hello\n")}) {
    expect_error(ErrorCode::no_data, {"a.obj", "no triangle"}, [&] { read_obj(empty, "a.obj"); });
  }
}

TEST(ObjReader, LimitsHold) {
  MeshLimits limits;
  limits.max_vertices = 3;
  expect_error(ErrorCode::limit_exceeded, {"a.obj:4", "3 vertices"}, [&] { read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", "a.obj", limits); });
  limits.max_triangles = 1;
  expect_error(ErrorCode::limit_exceeded, {"1 triangles"}, [&] { read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 1\n", "a.obj", limits); });
}

const std::string ascii_header =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
    "element face 1\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nend_header\n";

TEST(PlyReader, ReadsText) {
  const Mesh m = read_ply(bytes_of(ascii_header + "0 0 0 255\n1 0 0 255\n1 1 0 7\n0 1 0 0\n4 0 1 2 3\n0\n"), "a.ply");
  EXPECT_EQ(m.positions.size(), 4U);
  EXPECT_EQ(m.triangles.size(), 2U);
  EXPECT_EQ(m.positions[2], Vec3f(1, 1, 0));
  EXPECT_TRUE(m.normals.empty());
}

template <class T>
void put(std::string& to, T value, bool big) {
  std::string raw(sizeof value, 0);
  std::memcpy(raw.data(), &value, sizeof value);
  if (big == (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
  to += raw;
}

std::string binary_ply(bool big) {
  std::string file = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                     "_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                     "property float s\nproperty float t\nelement face 1\nproperty uchar flags\nproperty list ushort uint vertex_index\nend_header\n";
  const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  for (const auto& c : corners) {
    for (const double v : c) put(file, v, big);
    for (const float v : {0.0f, 0.0f, 3.0f}) put(file, v, big);
    for (const double v : {c[0], c[1]}) put(file, static_cast<float>(v), big);
  }
  put(file, std::uint8_t{9}, big);
  put(file, std::uint16_t{3}, big);
  for (const std::uint32_t i : {0U, 1U, 2U}) put(file, i, big);
  return file;
}

TEST(PlyReader, ReadsBothByteOrders) {
  for (const bool big : {false, true}) {
    const Mesh m = read_ply(bytes_of(binary_ply(big)), "a.ply");
    ASSERT_EQ(m.positions.size(), 3U);
    EXPECT_EQ(m.positions[2], Vec3f(0, 2, 0));
    EXPECT_EQ(m.normals[1], Vec3f(0, 0, 1));
    EXPECT_EQ(m.uvs[2], glm::vec2(0, 2));
    ASSERT_EQ(m.triangles.size(), 1U);
    EXPECT_EQ(m.triangles[0], glm::uvec3(0, 1, 2));
  }
}

TEST(PlyWriter, IsReadBackBitForBit) {
  Mesh m{{{0, -0.0f, 1e-30f}, {1, 0, 0}, {1.0f / 3, 1, 0}, {7, 8, 9}}, {}, {}, {{0, 1, 2}, {3, 2, 1}}};
  for (const bool normals : {false, true}) {
    for (const bool uvs : {false, true}) {
      m.normals.clear();
      m.uvs.clear();
      if (normals) m.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0.6f, 0, 0.8f}};
      if (uvs) m.uvs = {{0, 0}, {1, 0}, {0, 1}, {0.1f, 2}};
      const Mesh read = read_ply(write_ply(m), "a.ply");
      EXPECT_EQ(read.positions, m.positions);
      EXPECT_TRUE(std::signbit(read.positions[0].y));
      EXPECT_EQ(read.normals, m.normals);
      EXPECT_EQ(read.uvs, m.uvs);
      EXPECT_EQ(read.triangles, m.triangles);
    }
  }
}

TEST(PlyReader, EveryCutIsRefused) {
  const std::string whole = binary_ply(false);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THROW(read_ply(bytes_of(whole.substr(0, length)), "a.ply"), Error) << length;
  }
}

TEST(PlyReader, BadFilesAreRefused) {
  const auto refused = [](ErrorCode code, const std::string& text, std::initializer_list<const char*> words) {
    SCOPED_TRACE(text);
    expect_error(code, words, [&] { read_ply(bytes_of(text), "a.ply"); });
  };
  const std::string data = "0 0 0 255\n1 0 0 255\n1 1 0 7\n0 1 0 0\n";
  refused(ErrorCode::not_recognized, "v 0 0 0\n", {"a.ply", "PLY"});
  refused(ErrorCode::malformed, "ply\nformat utf8 1.0\nend_header\n", {"a.ply:2", "'utf8'"});
  refused(ErrorCode::malformed, "ply\nend_header\n", {"format"});
  refused(ErrorCode::malformed, "ply\nformat ascii 1.0\nproperty float x\nend_header\n", {"a.ply:3", "property"});
  refused(ErrorCode::malformed, "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", {"'-1'"});
  refused(ErrorCode::malformed, "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", {"'quad'"});
  refused(ErrorCode::malformed, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", {"x, y or z"});
  refused(ErrorCode::malformed, ascii_header + data + "4 0 1 2 4\n0\n", {"vertex 4"});
  refused(ErrorCode::malformed, ascii_header + data + "2 0 1\n0\n", {"2 corners"});
  refused(ErrorCode::malformed, ascii_header + data + "4 0 1 2 -1\n0\n", {"index"});
  refused(ErrorCode::malformed, ascii_header + "0 0 nan 255\n1 0 0 255\n1 1 0 7\n0 1 0 0\n4 0 1 2 3\n0\n", {"vertex 0", "finite"});
  refused(ErrorCode::malformed, ascii_header + "0 0 zero 255\n", {"'zero'"});
  refused(ErrorCode::truncated, ascii_header + data + "4 0 1 2\n", {"ends"});
  refused(ErrorCode::no_data, "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n", {"no triangle"});
}

TEST(PlyReader, HugeCountsAllocateNothing) {
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex ", rest = "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  expect_error(ErrorCode::limit_exceeded, {"18446744073709551615"}, [&] { read_ply(bytes_of(header + "18446744073709551615" + rest), "a.ply"); });
  expect_error(ErrorCode::truncated, {"ends"}, [&] { read_ply(bytes_of(header + "30000000" + rest), "a.ply"); });
}

TEST(SmoothNormals, OfACubeCornerAreTheMeanOfItsFaces) {
  // Three faces of two or one triangles each meet at the origin: the cut must not matter.
  Mesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  m.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {0, 4, 6}, {0, 6, 3}};
  EXPECT_GT(glm::dot(smooth_normals(m)[0], glm::normalize(Vec3f(-1, -1, -1))), 0.99999f);
}

}  // namespace
}  // namespace brdf::render
