// SPDX-License-Identifier: Apache-2.0
// What decoding allocates, counted: never more than check_file says, and under tight limits never more than these.
#include "support/brdfc_content.h"
#include "support/golden_bytes.h"

#include <brdf/check.h>
#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <malloc.h>
#include <atomic>
#include <cstdlib>
#include <new>
#include <string>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BRDF_COUNTS_MEMORY 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BRDF_COUNTS_MEMORY 0
#endif
#endif
#ifndef BRDF_COUNTS_MEMORY
#define BRDF_COUNTS_MEMORY 1
#endif

#if BRDF_COUNTS_MEMORY  // a sanitizer has allocation functions of its own

namespace {

std::atomic<std::size_t> in_use{0}, peak{0};

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  const std::size_t now = in_use += ::malloc_usable_size(p);
  if (now > peak) peak = now;  // one thread allocates in these tests
  return p;
}

void released(void* p) noexcept {
  if (p == nullptr) return;
  in_use -= ::malloc_usable_size(p);
  std::free(p);
}

}  // namespace

// The forms for arrays, and those with a size, call these.
void* operator new(std::size_t size) { return counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* p) noexcept { released(p); }
void operator delete(void* p, std::size_t) noexcept { released(p); }
void operator delete(void* p, std::align_val_t) noexcept { released(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { released(p); }

namespace brdf {
namespace {

/// Most bytes that were in use at once during `action`, beyond those in use before it.
template <class Action>
std::uint64_t peak_of(Action&& action) {
  const std::size_t before = in_use;
  peak = before;
  action();
  return peak - before;
}

/// Bookkeeping whose size no file changes: directory, strings, handles, the model of a layer, and what malloc rounds up.
constexpr std::uint64_t bookkeeping = 32768;

container::Content wide_content(int channels) {
  container::Content c;
  c.component.channels = {ChannelModel::spectral, channels, {}};
  for (int i = 0; i < channels; ++i) c.component.channels.wavelengths_nm.push_back(static_cast<float>(300 + i));
  c.component.transform = residual::ChannelTransform::cosine;
  c.lobes = test::lobes_of_each_kind(channels);
  const auto ends = [channels](std::uint32_t end) { return std::vector<std::uint32_t>(static_cast<std::size_t>(channels), end); };
  c.residual = test::residual_of(channels, false, {{40, false, ends(300)}, {48, true, ends(400)}});
  for (int i = 1; i <= 2; ++i)
    for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact}) c.errors.push_back({i, level, 0.1, 20});
  return c;
}

container::Content wide_slices(int channels) {
  container::Content c = wide_content(channels);
  c.component.axes = container::AxesKind::slices;
  residual::SliceFrame& f = c.residual.slices;
  f.theta_i = {0, 9000, 20000, 35000, 50000, 62000};
  f.width = f.height = 32;
  f.rows = 64;
  for (int i = 0; i < 200; ++i) f.ndf.push_back(static_cast<std::int16_t>(100 - i));
  f.ndf_step = 8;
  f.epsilon = 118;
  return c;
}

std::vector<test::GoldenFile> files() {
  std::vector<test::GoldenFile> all = test::golden_files();
  all.push_back({"24 channels", container::pack(wide_content(24))});
  all.push_back({"24 channels in slices", container::pack(wide_slices(24))});
  return all;
}

TEST(DecodeMemory, StaysWithinWhatCheckFileSays) {
  for (const test::GoldenFile& file : files()) {
    const FileCheck check = check_file(file.bytes);
    ASSERT_FALSE(check.problem) << file.name << ": " << check.problem->what();
    for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
      ASSERT_TRUE(check.readable(level)) << file.name << ' ' << to_string(level);
      DecodeOptions options;
      options.level = level;
      const std::uint64_t found = peak_of([&] { (void)Material::decode(file.bytes, options); });
      const std::uint64_t said = check.at(level).table_bytes + check.at(level).temporary_bytes + check.sampling_bytes;
      EXPECT_LE(found, said + bookkeeping) << file.name << ' ' << to_string(level);
      EXPECT_LE(said, 4 * found) << file.name << ' ' << to_string(level) << ": a figure so far above is of no use";
    }
  }
}

TEST(DecodeMemory, PrepareStaysWithinItToo) {
  for (const test::GoldenFile& file : files()) {
    const FileCheck check = check_file(file.bytes);
    DecodeOptions options;
    options.level = EvalLevel::fast;
    const Material m = Material::decode(file.bytes, options);
    for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact}) {
      const std::uint64_t found = peak_of([&] { (void)m.prepare(level); });
      EXPECT_LE(found, check.at(level).table_bytes + check.at(level).temporary_bytes + check.sampling_bytes + bookkeeping) << file.name;
    }
  }
}

TEST(DecodeMemory, CheckFileItselfTakesNoTables) {
  for (const test::GoldenFile& file : files()) {
    const FileCheck check = check_file(file.bytes);
    const std::uint64_t found = peak_of([&] { (void)check_file(file.bytes); });
    EXPECT_LE(found, check.at(EvalLevel::fast).temporary_bytes + bookkeeping) << file.name;
  }
}

TEST(DecodeMemory, TightLimitsHoldBeforeAnythingIsTaken) {
  for (const test::GoldenFile& file : files())
    for (std::uint64_t most = 1024; most < (std::uint64_t{1} << 25); most *= 2) {
      DecodeOptions options;
      options.limits.max_temporary_bytes = most;
      options.limits.max_table_bytes = most;
      options.level = EvalLevel::exact;
      options.sampling = false;
      const std::uint64_t found = peak_of([&] {
        try {
          (void)Material::decode(file.bytes, options);
        } catch (const Error& e) {
          EXPECT_EQ(e.code(), ErrorCode::limit_exceeded) << e.what();
        }
      });
      EXPECT_LE(found, 2 * most + bookkeeping) << file.name;
    }
}

}  // namespace
}  // namespace brdf

#endif
