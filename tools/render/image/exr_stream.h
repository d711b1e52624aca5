// SPDX-License-Identifier: Apache-2.0
// OpenEXR's streams over memory, so that files go through the one reader and the one atomic writer of this project.
#pragma once

#include <OpenEXR/ImfIO.h>
#include <OpenEXR/Iex.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace brdf::render {

class ExrInput : public Imf::IStream {
 public:
  explicit ExrInput(std::span<const std::byte> bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char c[], int n) override {
    if (n < 0 || position_ > bytes_.size() || static_cast<std::size_t>(n) > bytes_.size() - position_) {
      ended_early_ = true;
      throw Iex::InputExc("the file ends too early");
    }
    std::memcpy(c, bytes_.data() + position_, static_cast<std::size_t>(n));
    position_ += static_cast<std::size_t>(n);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }
  /// Whether more was asked for than there is.
  bool ended_early() const noexcept { return ended_early_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool ended_early_ = false;
};

class ExrOutput : public Imf::OStream {
 public:
  ExrOutput() : OStream("memory") {}
  void write(const char c[], int n) override {
    const std::size_t size = static_cast<std::size_t>(std::max(n, 0));
    if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
    std::memcpy(bytes_.data() + position_, c, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }
  const std::vector<std::byte>& bytes() const noexcept { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t position_ = 0;
};

}  // namespace brdf::render
