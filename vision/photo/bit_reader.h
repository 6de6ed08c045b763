// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace bladecurve {

// Bits of entropy-coded data, without the zeros stuffed behind bytes of 255 (ITU-T T.81, B.1.1.5).
class BitReader {
 public:
  explicit BitReader(std::string_view data)
      : first_(reinterpret_cast<const std::uint8_t*>(data.data())),
        next_(first_),
        last_(first_ + data.size()) {}

  // The next bits, the first on top: at least as many as a code and its value may have.
  [[nodiscard]] std::uint64_t Window() {
    if (bits_ < kLeastBits) Refill();
    return window_;
  }
  void Skip(int bits) {
    window_ <<= static_cast<unsigned>(bits);
    bits_ -= bits;
  }
  [[nodiscard]] bool ran_out() const { return ran_out_; }  // of data, or met a marker

  // Where the next bit is: a byte's place in the data, and how many of its bits are read already.
  struct Place {
    size_t byte = 0;
    int bits = 0;
  };
  [[nodiscard]] Place At() const {
    const std::uint8_t* byte = next_;
    for (int unread = bits_; unread > 0; unread -= 8) {
      --byte;
      if (byte > first_ && byte[0] == 0 && byte[-1] == 0xff) --byte;
    }
    return {static_cast<size_t>(byte - first_), (8 - bits_ % 8) % 8};
  }

 private:
  void Refill() {
    if (last_ - next_ >= 8) {
      std::uint64_t bytes = 0;
      std::memcpy(&bytes, next_, 8);
      if (!HasByteOf255(bytes)) {
        const int count = (63 - bits_) / 8;
        window_ |= BigEndian(bytes) >> static_cast<unsigned>(bits_);
        next_ += count;
        bits_ += 8 * count;
        return;  // bits beyond those counted are read into the same places again
      }
    }
    RefillByBytes();
  }
  void RefillByBytes() {
    for (; bits_ <= 56; bits_ += 8) {
      if (next_ == last_ || (*next_ == 0xff && (next_ + 1 == last_ || next_[1] != 0))) {
        ran_out_ = true;
        continue;
      }
      window_ |= std::uint64_t{*next_} << (56U - static_cast<unsigned>(bits_));
      next_ += *next_ == 0xff ? 2 : 1;
    }
  }
  static bool HasByteOf255(std::uint64_t bytes) {
    return (bytes & ~(bytes + 0x0101010101010101U) & 0x8080808080808080U) != 0;
  }
  static std::uint64_t BigEndian(std::uint64_t bytes) {
    return std::endian::native == std::endian::big ? bytes : __builtin_bswap64(bytes);
  }

  static constexpr int kLeastBits = 32;  // codes have at most 16, values 15

  const std::uint8_t* first_;
  const std::uint8_t* next_;
  const std::uint8_t* last_;
  std::uint64_t window_ = 0;
  int bits_ = 0;
  bool ran_out_ = false;
};

}  // namespace bladecurve
