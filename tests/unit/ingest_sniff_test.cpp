// SPDX-License-Identifier: Apache-2.0
// Formats are told by content.
#include <brdf/ingest.h>

#include "base/file_magic.h"
#include "support/merl_bytes.h"

#include <gtest/gtest.h>

namespace brdf {
namespace {

FileFormat sniff_text(const std::string& text) {
  std::vector<std::byte> bytes;
  test::append_text(bytes, text);
  return sniff(bytes, bytes.size());
}

TEST(IngestSniff, KnowsEachFormat) {
  EXPECT_EQ(sniff_text(std::string(base::brdfc_magic) + std::string("\0\1", 2)), FileFormat::brdfc);
  EXPECT_EQ(sniff(test::small_rgl_material().build(), 1000), FileFormat::rgl);
  EXPECT_EQ(sniff(test::merl_header({90, 90, 180}), 34992012), FileFormat::merl);
  EXPECT_EQ(sniff(test::merl_header({90, 90, 360}), 69984012), FileFormat::merl);
  EXPECT_EQ(sniff_text("version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 34992012\n"),
            FileFormat::git_lfs_pointer);
  EXPECT_EQ(sniff_text("#DIM 2 3\r\n\t0.5 caf\xc3\xa9\n"), FileFormat::text);
}

TEST(IngestSniff, ATruncatedMerlTableIsStillOne) {
  EXPECT_EQ(sniff(test::merl_header({90, 90, 180}), 100), FileFormat::merl);
}

TEST(IngestSniff, AFileOfTheSizeOfAMerlTableIsOneWithABadHeader) {
  EXPECT_EQ(sniff(test::merl_header({0, 0, 0}), 34992012), FileFormat::merl);
}

TEST(IngestSniff, NothingElseIsKnown) {
  EXPECT_EQ(sniff({}, 0), FileFormat::unknown);
  EXPECT_EQ(sniff(test::merl_header({90, 90, 181}), 100), FileFormat::unknown);
  EXPECT_EQ(sniff(test::merl_header({-90, -90, 180}), 100), FileFormat::unknown);
  EXPECT_EQ(sniff(test::merl_header({65536, 65536, 180}), 100), FileFormat::unknown);
  EXPECT_EQ(sniff_text(std::string("tensor_file", 11)), FileFormat::text);  // without its NUL
  EXPECT_EQ(sniff_text("\x7f"
                       "ELF"),
            FileFormat::unknown);
}

}  // namespace
}  // namespace brdf
