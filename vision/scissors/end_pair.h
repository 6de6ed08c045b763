// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "vision/pivot/pivot.h"
#include "vision/scale/scale.h"
#include "vision/scissors/located_blade.h"

namespace bladecurve {

// The blades of a pair are equally long, from the pivot to their distal ends. Where markers tell
// the tilt of the view, rival ends that make a pair and are much better seen are taken, and the end
// that is seen less well follows the other one, each as far as its uncertainty says, also a
// shadow's arc beside none; if they contradict each other and the tip's arc is seen on one blade
// alone, or on the other one that of a shadow, the other's end is put at that blade's length; so is
// the end of a blade that is shorter by far, as where its tip fades into the ground, if the longer
// one's arc is seen more clearly, or neither is seen at all; else both become as uncertain as they
// differ. Without markers a slant may be the reason, and the ends stay; the shorter one's is
// doubted where no slant is. They stay, too, about a given pivot that does not lie behind the
// blades. Changes `end`, not `used`, and sets `ends_contradict`.
void AgreeOnEnds(const ScaleResult& scale, const Pivot& pivot, Blades* blades);

// Refuses blades whose ends contradict each other if the shorter one, as long as the other, would
// run out of the picture: what is seen of it is no tip. For ends that were agreed on.
void RefuseCutOffBlade(const ScaleResult& scale,
                       const Pivot& pivot,
                       const Blades& blades,
                       const cv::Size& picture);

}  // namespace bladecurve
