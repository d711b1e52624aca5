// SPDX-License-Identifier: Apache-2.0
// NumPy archives: those that numpy writes, and those that nobody should trust.
#include "peers/npz_file.h"

#include "peers/npz_writer.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <numeric>

namespace brdf {
namespace {

using peers::NpzFile;
using test::expect_error;
using test::npy;
using test::TemporaryFile;

std::vector<float> counting(std::size_t n) {
  std::vector<float> values(n);
  std::iota(values.begin(), values.end(), 0.5F);
  return values;
}

TEST(NpzFile, ReadsStoredAndDeflatedEntries) {
  const TemporaryFile file;
  for (const bool deflated : {false, true}) {
    file.write_archive({{"first", npy(counting(7))}, {"second-one", npy(counting(675))}}, deflated);
    const NpzFile npz(file.path());
    EXPECT_EQ(npz.floats("first"), counting(7));
    EXPECT_EQ(npz.floats("second-one"), counting(675));
    EXPECT_EQ(npz.floats("third"), std::nullopt);
    EXPECT_EQ(npz.floats("first.npy"), std::nullopt);
  }
}

TEST(NpzFile, EveryShorterFileIsRefused) {
  const TemporaryFile file;
  file.write_archive({{"weights", npy(counting(40))}}, true);
  const std::string whole = file.read();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    file.write(whole.substr(0, size));
    EXPECT_THROW(NpzFile(file.path()).floats("weights"), Error) << size;
  }
}

TEST(NpzFile, DamageNeverPassesForOtherNumbers) {
  const TemporaryFile file;
  file.write_archive({{"weights", npy(counting(40))}}, true);
  const std::string whole = file.read();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    file.write(damaged);
    try {
      const auto values = NpzFile(file.path()).floats("weights");
      EXPECT_EQ(values.value_or(counting(40)), counting(40)) << at;
    } catch (const Error&) {  // as it should be, except where a byte has no meaning, or is part of the name
    }
  }
}

TEST(NpzFile, RefusesWhatIsNoArchive) {
  const TemporaryFile file;
  expect_error(ErrorCode::io, {"brdf-npz"}, [&] { NpzFile{file.path()}; });
  file.write("");
  expect_error(ErrorCode::malformed, {"zip"}, [&] { NpzFile{file.path()}; });
  file.write(npy(counting(3)));
  expect_error(ErrorCode::malformed, {"zip"}, [&] { NpzFile{file.path()}; });
}

void expect_refused(ErrorCode code, std::initializer_list<const char*> words, const std::string& entry) {
  const TemporaryFile file;
  file.write_archive({{"weights", entry}}, true);
  expect_error(code, words, [&] { NpzFile(file.path()).floats("weights"); });
}

TEST(NpzFile, RefusesOtherShapesAndTypes) {
  expect_refused(ErrorCode::unsupported, {"weights", "one axis"}, npy("<f4", "(2, 3)", counting(6)));
  expect_refused(ErrorCode::unsupported, {"one axis"}, npy("<f4", "()", counting(1)));
  expect_refused(ErrorCode::unsupported, {"one axis"}, npy("<f4", "(-6,)", counting(6)));
  expect_refused(ErrorCode::unsupported, {"one axis"}, npy("<f4", "(99999999999999999999,)", counting(6)));
  expect_refused(ErrorCode::unsupported, {"<f4"}, npy("<i4", "(6,)", counting(6)));
  expect_refused(ErrorCode::unsupported, {"<f4"}, npy(">f4", "(6,)", counting(6)));
  expect_refused(ErrorCode::unsupported, {"<f4"}, npy("|O", "(6,)", counting(6)));
}

TEST(NpzFile, RefusesArraysThatContradictTheirHeader) {
  expect_refused(ErrorCode::truncated, {"shape says 7"}, npy("<f4", "(7,)", counting(6)));
  expect_refused(ErrorCode::truncated, {"shape says 5"}, npy("<f4", "(5,)", counting(6)));
  expect_refused(ErrorCode::truncated, {"shape says"}, npy("<f8", "(4611686018427387904,)", counting(6)));
  std::string cut = npy(counting(6));
  expect_refused(ErrorCode::truncated, {"header"}, cut.substr(0, 40));
  expect_refused(ErrorCode::malformed, {"NumPy"}, cut.substr(0, 6));
  expect_refused(ErrorCode::malformed, {"NumPy"}, "");
  expect_refused(ErrorCode::malformed, {"NumPy"}, "no array at all, but long enough");
}

TEST(NpzFile, RefusesAnEntryThatUnpacksToTooMuch) {
  expect_refused(ErrorCode::limit_exceeded, {"at most"}, std::string(std::size_t{3} << 20, '\0'));
}

}  // namespace
}  // namespace brdf
