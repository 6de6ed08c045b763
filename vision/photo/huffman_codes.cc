// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/huffman_codes.h"

#include <algorithm>

namespace bladecurve {
namespace {

constexpr int kLongestCode = 16;
constexpr int kSixteenZeros = 0xf0;

}  // namespace

HuffmanCodes::HuffmanCodes(const HuffmanTable& table) {
  unsigned code = 0;
  size_t next = 0;
  for (int bits = 1; bits <= kLongestCode; ++bits, code <<= 1U) {
    for (int i = 0; i < table.num_codes[static_cast<size_t>(bits)]; ++i, ++code) {
      if (code >> static_cast<unsigned>(bits) != 0) return;  // more codes than there can be
      Add({static_cast<std::uint8_t>(bits),
           table.symbols[next++],
           static_cast<std::uint16_t>(code)});
    }
  }
}

void HuffmanCodes::Add(const Code& code) {
  of_symbol_[code.symbol] = code;
  if (code.bits > kPeekBits) {
    long_.push_back(code);
    return;
  }
  const unsigned free = static_cast<unsigned>(kPeekBits) - code.bits;
  std::fill_n(short_.begin() + (code.code << free), 1U << free, code);
}

HuffmanCodes::Code HuffmanCodes::LongCodeAt(std::uint64_t window) const {
  const auto found = std::find_if(long_.begin(), long_.end(), [&](const Code& code) {
    return window >> (64U - code.bits) == code.code;
  });
  return found == long_.end() ? Code{} : *found;
}

AcCodes::AcCodes(const HuffmanTable& table) : codes_(table) {
  for (std::uint64_t top = 0; top < steps_.size(); ++top)
    steps_[top] = StepsWithin(top << (64 - HuffmanCodes::kPeekBits));
}

AcCodes::Step AcCodes::StepOf(const HuffmanCodes::Code& code) {
  const int size = code.symbol & 15, run = code.symbol >> 4;
  if (code.bits == 0) return {};
  if (size == 0 && code.symbol != kSixteenZeros) return {code.bits, kToBlockEnd};
  return {static_cast<std::uint8_t>(code.bits + size), static_cast<std::uint8_t>(run + 1)};
}

AcCodes::Step AcCodes::StepsWithin(std::uint64_t window) const {
  Step all = {};
  while (all.coefficients < kToBlockEnd) {
    const Step next = StepAt(window << all.bits);
    if (next.bits == 0 || all.bits + next.bits > HuffmanCodes::kPeekBits) break;
    if (next.coefficients < kToBlockEnd && all.coefficients + next.coefficients >= kToBlockEnd)
      break;  // codes that no block can hold
    all.bits = static_cast<std::uint8_t>(all.bits + next.bits);
    all.coefficients = static_cast<std::uint8_t>(all.coefficients + next.coefficients);
  }
  return all;
}

}  // namespace bladecurve
