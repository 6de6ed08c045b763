// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace bladecurve {

// SHA-256 (FIPS 180-4) of `bytes` as 64 lower-case hex digits. Uses the processor's SHA
// instructions where it has them.
[[nodiscard]] std::string Sha256Hex(std::string_view bytes);

}  // namespace bladecurve
