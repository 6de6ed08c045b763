// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/photo/sha256.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "vision/photo/sha256_blocks.h"

namespace bladecurve {
namespace {

constexpr size_t kBlockBytes = 64;

void PortableBlocks(Sha256State* state, const unsigned char* bytes, size_t blocks) {
  std::array<uint32_t, 64> w;
  for (; blocks > 0; --blocks, bytes += kBlockBytes) {
    for (size_t t = 0; t < 16; ++t) {
      w[t] = uint32_t{bytes[4 * t]} << 24 | uint32_t{bytes[4 * t + 1]} << 16 |
             uint32_t{bytes[4 * t + 2]} << 8 | uint32_t{bytes[4 * t + 3]};
    }
    for (size_t t = 16; t < 64; ++t) {
      const uint32_t a = w[t - 15], b = w[t - 2];
      const uint32_t s0 = std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3);
      const uint32_t s1 = std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10);
      w[t] = w[t - 16] + s0 + w[t - 7] + s1;
    }
    // FIPS 180-4, 6.2.2, with its names.
    auto [a, b, c, d, e, f, g, h] = *state;
    for (size_t t = 0; t < 64; ++t) {
      const uint32_t big1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
      const uint32_t t1 = h + big1 + ((e & f) ^ (~e & g)) + kSha256Constants[t] + w[t];
      const uint32_t big0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
      const uint32_t t2 = big0 + ((a & b) ^ (a & c) ^ (b & c));
      h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
    }
    const Sha256State sum = {a, b, c, d, e, f, g, h};
    for (size_t i = 0; i < 8; ++i) (*state)[i] += sum[i];
  }
}

std::string Hex(const Sha256State& state) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  for (const uint32_t word : state) {
    for (int shift = 28; shift >= 0; shift -= 4) hex += kDigits[(word >> shift) & 15];
  }
  return hex;
}

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  const auto add_blocks = HasShaInstructions() ? ShaInstructionBlocks : PortableBlocks;
  Sha256State state = {0x6a09e667,
                       0xbb67ae85,
                       0x3c6ef372,
                       0xa54ff53a,
                       0x510e527f,
                       0x9b05688c,
                       0x1f83d9ab,
                       0x5be0cd19};
  const unsigned char* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  const size_t whole = bytes.size() / kBlockBytes;
  add_blocks(&state, data, whole);
  // Padding: a one bit, zeros, and the length in bits as 64-bit big endian.
  std::array<unsigned char, 2 * kBlockBytes> tail{};
  const size_t rest = bytes.size() - whole * kBlockBytes;
  if (rest > 0) std::memcpy(tail.data(), data + whole * kBlockBytes, rest);
  tail[rest] = 0x80;
  const size_t tail_blocks = rest + 9 <= kBlockBytes ? 1 : 2;
  const uint64_t bits = uint64_t{bytes.size()} * 8;
  for (size_t i = 0; i < 8; ++i) {
    tail[tail_blocks * kBlockBytes - 1 - i] = static_cast<unsigned char>(bits >> (8 * i));
  }
  add_blocks(&state, tail.data(), tail_blocks);
  return Hex(state);
}

}  // namespace bladecurve
