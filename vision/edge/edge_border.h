// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "vision/edge/edge.h"
#include "vision/edge/edge_line.h"
#include "vision/edge/edge_path.h"
#include "vision/edge/edge_survey.h"

namespace bladecurve {

// The transition that is the blade's border, as a line in a survey of the picture; of the picture
// smoothed where its noise hides the border, so that steps look up to 2 px softer.
struct SurveyedBorder {
  Survey survey;
  StepLine line;
};

[[nodiscard]] SurveyedBorder FindBorder(const cv::Mat& grey,
                                        const EdgePath& guess,
                                        double search_px);

// The line along which light changes most clearly from the blade's to the shadow's; its score is
// the share of it that is seen.
[[nodiscard]] SurveyedBorder FindShadow(const cv::Mat& grey,
                                        const EdgePath& guess,
                                        double search_px,
                                        Shadow shadow);

inline constexpr float kStiffBend =
    0.5F;  // once straightened, it takes two clear stations to leave a line

// Median height along the line, clear or not.
[[nodiscard]] double HeightUnder(const StepMap& map, const StepLine& line);

// A fall of light, going outwards, far greater than that of a line: no shadow does that, however
// soft it is.
[[nodiscard]] bool FallsDeeper(const StepMap& map, int station, int row, double line_height);

}  // namespace bladecurve
