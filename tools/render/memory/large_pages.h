// SPDX-License-Identifier: Apache-2.0
// Memory for arrays that are read all over: with pages of 4 KiB each read would miss the table of pages as well.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace brdf::render {

/// Allocator that asks the system for large pages where an array fills at least half of one. It is a wish: whether it is granted changes
/// times alone.
template <class T>
struct LargePages {
  using value_type = T;

  LargePages() noexcept = default;
  template <class U>
  LargePages(const LargePages<U>&) noexcept {}  // NOLINT(google-explicit-constructor): allocators convert

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (n > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const bool large = bytes >= page / 2;
    const std::size_t unit = large ? page : line;
    void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (!memory) throw std::bad_alloc();
#if defined(__linux__)
    if (large) static_cast<void>(madvise(memory, (bytes + unit - 1) / unit * unit, MADV_HUGEPAGE));
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }

  template <class U>
  bool operator==(const LargePages<U>&) const noexcept {
    return true;
  }

 private:
  static constexpr std::size_t page = std::size_t{1} << 21, line = 64;
  static_assert(alignof(T) <= line);
};

}  // namespace brdf::render
