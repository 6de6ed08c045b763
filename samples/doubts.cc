// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "samples/doubts.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace bladecurve {
namespace {

struct Doubt {
  std::string_view code, meaning;
};

// In the order of the stages that raise them.
constexpr std::array kDoubts = {
    Doubt{"scene_doubtful",
          "the scissors hardly stand out; see in the overlay that the edges lie on the blades"},
    Doubt{"scale_from_file_dpi",
          "the scale is the file's own dpi, true of scans alone; give --dpi if it is one"},
    Doubt{"scale_four_corners",
          "one marker gives the scale and nothing confirms it; show more markers, or the card"},
    Doubt{"sheet_bent", "the markers do not lie in one plane; flatten the sheet"},
    Doubt{"camera_near",
          "from so near, heights matter much; go 300 mm away, and measure --plane-height-mm well"},
    Doubt{
        "camera_unknown",
        "how far away the camera is, and so what a height does, is a guess; lean it by 10 degrees, "
        "which shows the markers in perspective, or give --camera"},
    Doubt{"plane_height_unknown",
          "the blades lie above the sheet, by 0 +- 2 mm as is assumed; give --plane-height-mm"},
    Doubt{"marker_overexposed", "the paper is brighter than white; expose less"},
    Doubt{"size_unusual",
          "hardly any scissors have blades of that length; check the flag that gives the scale"},
    Doubt{"pivot_not_seen",
          "no screw is seen, the blades alone say where they turn; light it, or give --pivot"},
    Doubt{"pivot_faint", "the screw hardly shows, or only in part; light it, or give --pivot"},
    Doubt{"pivot_off_screw",
          "a screw is plainly seen elsewhere than --pivot says; check the flag, or leave it out"},
    Doubt{"blades_asymmetric",
          "the edges are no mirror images: the view is oblique, or one is a shadow's or bevel's"},
    Doubt{"blades_bent",
          "both blades are bent to one side, so that neither edge confirms the other"},
    Doubt{"ends_unlike",
          "the blades seem to be of unlike length; one tip may not be where it seems"},
    Doubt{"upper_edge_ambiguous",
          "another line beside the upper edge may be the edge: a bevel, a shadow, a reflection"},
    Doubt{"lower_edge_ambiguous",
          "another line beside the lower edge may be the edge: a bevel, a shadow, a reflection"},
    Doubt{"upper_edge_vague",
          "the upper edge is known to more than a pixel only; use softer light"},
    Doubt{
        "upper_edge_overexposed",
        "the blade is plain white along its upper edge, which seems further out then; expose less"},
    Doubt{"marker_near_blade",
          "a marker's paper reaches a cutting edge or a tip; lay it a marker's width away"},
    Doubt{"theta_vague",
          "the angle is known to more than a quarter of a degree only; let the pivot and both tips "
          "show clearly, and markers the tilt of the view"},
    Doubt{
        "photographs_disagree",
        "one curve does not explain all photographs: other scissors, or a view that was not flat"},
    Doubt{"families_part",
          "the photographs leave open how the edge turns; add one at another angle"},
    Doubt{"theta_given_differs",
          "the given angle is not that between the distal ends: another definition, or a slip"},
    Doubt{"not_converged", "the fit did not come to an end; report this with the photograph"},
};

}  // namespace

std::string_view MeaningOfDoubt(std::string_view code) {
  const auto* found = std::find_if(
      kDoubts.begin(), kDoubts.end(), [&](const Doubt& doubt) { return doubt.code == code; });
  if (found == kDoubts.end())
    throw std::invalid_argument("MeaningOfDoubt: no result has " + std::string(code));
  return found->meaning;
}

}  // namespace bladecurve
