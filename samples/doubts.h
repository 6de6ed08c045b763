// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace bladecurve {

// What a warning's code means and what to do about it, in one sentence. Throws
// std::invalid_argument for a code that no result has.
[[nodiscard]] std::string_view MeaningOfDoubt(std::string_view code);

}  // namespace bladecurve
