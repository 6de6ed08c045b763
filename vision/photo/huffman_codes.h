// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bladecurve {

// A table as a JPEG file has it: how many codes there are of 1 to 16 bits, at 1 to 16, and the
// symbols that they stand for, in turn.
struct HuffmanTable {
  std::span<const std::uint8_t, 17> num_codes;
  std::span<const std::uint8_t, 256> symbols;
};

// The codes of a table, each known by the bits at the top of a window of 64.
// None is longer than 16 (ITU-T T.81, C.1).
class HuffmanCodes {
 public:
  struct Code {
    std::uint8_t bits = 0;  // 0: none
    std::uint8_t symbol = 0;
    std::uint16_t code = 0;
  };

  explicit HuffmanCodes(const HuffmanTable& table);

  [[nodiscard]] Code At(std::uint64_t window) const {
    const Code code = short_[window >> (64 - kPeekBits)];
    return code.bits > 0 ? code : LongCodeAt(window);
  }
  [[nodiscard]] Code Of(int symbol) const { return of_symbol_[static_cast<size_t>(symbol)]; }

  static constexpr int kPeekBits = 13;  // that are looked up at once

 private:
  void Add(const Code& code);
  [[nodiscard]] Code LongCodeAt(std::uint64_t window) const;

  std::array<Code, 1 << kPeekBits> short_ = {};
  std::vector<Code> long_;
  std::array<Code, 256> of_symbol_ = {};
};

// AC codes with their values, and by how many coefficients they go on (ITU-T T.81, F.1.2.2).
class AcCodes {
 public:
  struct Step {
    std::uint8_t bits = 0;  // 0: none
    std::uint8_t coefficients = 0;
  };
  static constexpr int kEndOfBlock = 0x00;         // the symbol
  static constexpr std::uint8_t kToBlockEnd = 64;  // coefficients of a step that ends its block

  explicit AcCodes(const HuffmanTable& table);

  // Several at once: those that are whole within the bits looked up.
  [[nodiscard]] Step StepsAt(std::uint64_t window) const {
    return steps_[window >> (64 - HuffmanCodes::kPeekBits)];
  }
  [[nodiscard]] Step StepAt(std::uint64_t window) const { return StepOf(codes_.At(window)); }
  [[nodiscard]] static Step StepOf(const HuffmanCodes::Code& code);
  [[nodiscard]] const HuffmanCodes& codes() const { return codes_; }

 private:
  [[nodiscard]] Step StepsWithin(std::uint64_t window) const;

  HuffmanCodes codes_;
  std::array<Step, 1 << HuffmanCodes::kPeekBits> steps_;
};

}  // namespace bladecurve
