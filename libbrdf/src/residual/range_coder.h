// SPDX-License-Identifier: Apache-2.0
// Adaptive binary range coder, carry-propagating, after Martin (1979) in the byte-wise form used by LZMA.
// Integer arithmetic only: the same bytes on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace brdf::residual {

/// Probability that the next bit is 1, in 1/65536, with a learning rate that starts fast and settles.
class AdaptiveBit {
 public:
  constexpr explicit AdaptiveBit(std::uint32_t p1 = 32768) noexcept : p1_(static_cast<std::uint16_t>(p1)) {}
  std::uint32_t p1() const noexcept { return p1_; }
  void update(bool bit) noexcept {
    // 1 / (n + 3.5) of the way for the first observations, in the end 1/43
    static constexpr std::uint16_t rate[16] = {18725, 14564, 11916, 10082, 8738, 7710, 6899, 6242,
                                               5699,  5243,  4855,  4520,  4228, 3972, 3745, 3542};
    const std::uint32_t r = count_ < 16 ? rate[count_] : settled(count_);
    const std::int32_t aim = bit ? 65535 - 327 : 327;  // never certain
    const std::int32_t gap = aim - static_cast<std::int32_t>(p1_);
    p1_ = static_cast<std::uint16_t>(static_cast<std::int32_t>(p1_) + gap * static_cast<std::int32_t>(r) / 65536);
    if (count_ < 40) ++count_;
  }

 private:
  static constexpr std::uint32_t settled(std::uint32_t n) noexcept { return 65536U / (n + 3U); }
  std::uint16_t p1_;
  std::uint8_t count_ = 0;
};

class RangeEncoder {
 public:
  bool bit(AdaptiveBit& model, bool b) {
    const std::uint32_t bound = static_cast<std::uint32_t>((std::uint64_t{range_} * model.p1()) >> 16);
    if (b) {
      range_ = bound;
    } else {
      low_ += bound;
      range_ -= bound;
    }
    model.update(b);
    while (range_ < (1U << 24)) {
      range_ <<= 8;
      shift_low();
    }
    return b;
  }
  /// `count` equiprobable bits, most significant first; count at most 24.
  std::uint32_t raw(int count, std::uint32_t value) {
    for (int i = count - 1; i >= 0; --i) {
      range_ >>= 1;
      if (((value >> i) & 1U) != 0) low_ += range_;
      while (range_ < (1U << 24)) {
        range_ <<= 8;
        shift_low();
      }
    }
    return value;
  }
  /// Ends the stream with the fewest bytes; the decoder reads zeros beyond the end.
  std::vector<std::byte> finish() {
    // any value in [low, low + range) will do: take the one with the most trailing zero bytes
    for (int drop = 32; drop >= 0; drop -= 8) {
      const std::uint64_t unit = std::uint64_t{1} << drop;
      const std::uint64_t v = (low_ + unit - 1) / unit * unit;
      if (v < low_ + range_) {
        low_ = v;
        break;
      }
    }
    for (int i = 0; i < 5; ++i) shift_low();
    // the decoder reads zeros beyond the end, but no more than four, so that a cut stream is noticed
    for (int i = 0; i < 4 && !bytes_.empty() && bytes_.back() == std::byte{0}; ++i) bytes_.pop_back();
    return std::move(bytes_);
  }

 private:
  void shift_low() {
    if (low_ < 0xFF000000U || low_ > 0xFFFFFFFFU) {
      const auto carry = static_cast<std::uint8_t>(low_ >> 32);
      if (started_) bytes_.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(cache_ + carry)));
      for (; pending_ > 0; --pending_) bytes_.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(0xFF + carry)));
      cache_ = static_cast<std::uint8_t>(low_ >> 24);
      started_ = true;
    } else {
      ++pending_;
    }
    low_ = (low_ & 0x00FFFFFFU) << 8;
  }
  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xFFFFFFFFU;
  std::uint8_t cache_ = 0;
  std::uint64_t pending_ = 0;
  bool started_ = false;
  std::vector<std::byte> bytes_;
};

class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) code_ = (code_ << 8) | next();
  }
  bool bit(AdaptiveBit& model, bool /*unknown*/ = false) noexcept {
    const std::uint32_t bound = static_cast<std::uint32_t>((std::uint64_t{range_} * model.p1()) >> 16);
    const bool b = code_ < bound;
    if (b) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
    }
    model.update(b);
    while (range_ < (1U << 24)) {
      range_ <<= 8;
      code_ = (code_ << 8) | next();
    }
    return b;
  }
  std::uint32_t raw(int count, std::uint32_t /*unknown*/ = 0) noexcept {
    std::uint32_t v = 0;
    for (int i = 0; i < count; ++i) {
      range_ >>= 1;
      const bool b = code_ >= range_;
      if (b) code_ -= range_;
      v = (v << 1) | static_cast<std::uint32_t>(b);
      while (range_ < (1U << 24)) {
        range_ <<= 8;
        code_ = (code_ << 8) | next();
      }
    }
    return v;
  }
  /// Bytes asked for beyond the end; the encoder never needs more than 4 of them.
  std::size_t overrun() const noexcept { return at_ > bytes_.size() ? at_ - bytes_.size() : 0; }
  /// Bytes never asked for; a stream of the encoder leaves none.
  std::size_t unread() const noexcept { return at_ < bytes_.size() ? bytes_.size() - at_ : 0; }

 private:
  std::uint32_t next() noexcept {
    const std::uint32_t b = at_ < bytes_.size() ? static_cast<std::uint32_t>(bytes_[at_]) : 0U;
    ++at_;
    return b;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::uint32_t code_ = 0, range_ = 0xFFFFFFFFU;
};

}  // namespace brdf::residual
