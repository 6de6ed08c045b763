// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

namespace bladecurve {

// The shadow of one member of a pair lies on the other one, too, and parts it in the mask
// (CV_8UC1): each part goes on as it ends, up to the largest one. `shift_px`: by how much the
// shadow lies aside.
void JoinPartedMembers(const cv::Vec2i& shift_px, cv::Mat* mask);

}  // namespace bladecurve
