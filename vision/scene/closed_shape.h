// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include "vision/scene/silhouette.h"

namespace bladecurve {

// Whether the silhouette is that of closed scissors: a rod without a gap, with rings at one end and
// a tip within the picture at the other. Closed clamps look the same.
[[nodiscard]] bool LooksClosed(const Silhouette& silhouette);

}  // namespace bladecurve
