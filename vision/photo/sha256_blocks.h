// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bladecurve {

using Sha256State = std::array<uint32_t, 8>;  // a to h of FIPS 180-4

// FIPS 180-4, 4.2.2.
extern const std::array<uint32_t, 64> kSha256Constants;

// True on x86-64 processors with the SHA extensions; the next function may be called only then.
[[nodiscard]] bool HasShaInstructions();
void ShaInstructionBlocks(Sha256State* state, const unsigned char* bytes, size_t blocks);

}  // namespace bladecurve
