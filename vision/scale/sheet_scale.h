// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vision/photo/photo.h"
#include "vision/scale/scale.h"

namespace bladecurve {

// Scale from markers of known size lying anywhere in the plane. Throws Refused{kNoScale} if none
// can be used.
[[nodiscard]] ScaleResult ScaleFromLooseMarkers(const Photo& photo, const ScaleOptions& options);

// Scale from the card that options.card names. Throws Refused{kNoScale} if none of its markers can
// be used, std::invalid_argument if its description cannot be read.
[[nodiscard]] ScaleResult ScaleFromCard(const Photo& photo, const ScaleOptions& options);

// The same from a built-in card, if a quick look finds one beyond doubt; std::nullopt else.
[[nodiscard]] std::optional<ScaleResult> ScaleFromCardIfSeen(const Photo& photo,
                                                             const ScaleOptions& options);

}  // namespace bladecurve
