// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/sheet_scale.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "vision/refused.h"
#include "vision/scale/card.h"
#include "vision/scale/known_camera.h"
#include "vision/scale/marker_corners.h"
#include "vision/scale/print_tone.h"
#include "vision/scale/sheet_pose.h"

namespace bladecurve {
namespace {

// Standard uncertainties of what is known beforehand.
constexpr double kInkSpreadMm = 0.05;  // of laser and inkjet prints on plain paper, each side

constexpr double kUnknownHeightMm = 2.0;  // cutting edges lie 0.5 to 4 mm above the table

std::vector<Eigen::Vector2d> InnerGrid(int width, int height) {
  std::vector<Eigen::Vector2d> places;
  for (const double y : {0.25, 0.5, 0.75}) {
    for (const double x : {0.25, 0.5, 0.75}) places.emplace_back(x * width, y * height);
  }
  return places;
}

std::vector<std::string> Warnings(const SheetSolution& solution,
                                  const std::vector<SeenMarker>& markers,
                                  const ScaleOptions& options) {
  // Nearer than this, a blade 2 mm above the sheet looks 0.8 % larger than what lies on it.
  constexpr double kNearMm = 250;
  // A sheet bowed by 1 mm moves corners by some pixels; tone and paper stay below a third of a
  // pixel.
  constexpr double kBentPx = 0.5, kBentChi2 = 4;
  std::vector<std::string> warnings;
  const bool focal_known = solution.log_focal_sigma < kFocalKnown;
  if (solution.surplus <= 0) warnings.emplace_back("scale_four_corners");
  if (solution.rms_px > kBentPx && solution.reduced_chi2 > kBentChi2)
    warnings.emplace_back("sheet_bent");
  if (focal_known && solution.pose.CameraHeightMm() < kNearMm) warnings.emplace_back("camera_near");
  if (!options.plane_height_mm) warnings.emplace_back("plane_height_unknown");
  if (!focal_known && options.plane_height_mm.value_or(0) != 0)
    warnings.emplace_back("camera_unknown");
  if (std::any_of(
          markers.begin(), markers.end(), [](const SeenMarker& m) { return m.overexposed; }))
    warnings.emplace_back("marker_overexposed");
  return warnings;
}

// Blades lie between the sheet and the camera, by far nearer to the sheet.
void CheckHeight(const SheetSolution& solution, double height_mm) {
  constexpr double kMost = 0.5;  // of the camera's height
  const double camera_mm = solution.pose.CameraHeightMm();
  if (height_mm <= kMost * camera_mm) return;
  throw std::invalid_argument("scale: blades " + std::to_string(std::lround(height_mm)) +
                              " mm above the sheet: the camera stands " +
                              std::to_string(std::lround(camera_mm)) +
                              " mm above it; give a smaller --plane-height-mm");
}

PlaneMap MapOf(const SheetSolution& solution,
               const std::vector<SeenMarker>& markers,
               const Photo& photo,
               const ScaleOptions& options) {
  const double height_mm = options.plane_height_mm.value_or(0);
  CheckHeight(solution, height_mm);
  const LengthPlace place{InnerGrid(photo.grey().cols, photo.grey().rows),
                          height_mm,
                          options.plane_height_mm ? kGivenHeightSigmaMm : kUnknownHeightMm};
  return PlaneMap::FromGeometry(solution.pose.PlaneAtHeight(height_mm),
                                RelativeSigma(solution, place),
                                options.marker_mm ? "marker" : "card")
      .WithWarnings(Warnings(solution, markers, options));
}

bool IsLocated(const SeenMarker& marker) { return std::isfinite(marker.corner_sigma_px); }

// The corners' own sigma knows of noise, not of the raster of the print or of paper that is not
// quite flat.
constexpr double kPaperSigmaPx = 0.015;

using ProblemFrom = std::function<SheetProblem(const std::vector<SeenMarker>&)>;

// False where locating the corners anew for this lens would move them by less than a few
// thousandths of a pixel.
bool LensBendsSides(const std::vector<SeenMarker>& markers, const Camera& camera) {
  constexpr double kMattersPx = 0.003;
  for (const SeenMarker& marker : markers) {
    for (int side = 0; side < 4; ++side) {
      if (std::abs(MarkerSide(marker.corners_px, side, {1, camera}).bow_px) > kMattersPx)
        return true;
    }
  }
  return false;
}

// The sheet, then once more with the lens just found where it bends the markers' sides. The tone
// curve moves no corner: see MarkerModel.
ScaleResult Solve(const Photo& photo,
                  const ScaleOptions& options,
                  std::vector<SeenMarker> markers,
                  const ProblemFrom& problem) {
  SheetSolution solution = SolveSheet(problem(markers));
  if (LensBendsSides(markers, solution.pose.camera)) {
    markers = RelocateMarkers(photo.grey(), SrgbToneCurve(), markers, solution.pose.camera);
    solution = SolveSheet(problem(markers));
  }
  ScaleResult result;
  result.map = MapOf(solution, markers, photo, options);
  result.sheet = std::move(solution);
  result.plane_height_mm = options.plane_height_mm.value_or(0);
  const ToneSeen tone = ToneOfPrint(markers);
  result.tone = ToThePower(SrgbToneCurve(), tone.exponent, tone.sigma);
  result.markers = std::move(markers);
  return result;
}

[[noreturn]] void RefuseMarkers(const std::vector<SeenMarker>& markers) {
  throw Refused(
      Reason::kNoScale,
      markers.empty()
          ? "scale: no marker of DICT_4X4_50 is seen; keep it whole in the picture, in focus, "
            "uncovered and with white paper around it, and do not mirror the picture"
          : "scale: a marker is seen, but not its four sides; keep it uncovered, sharp and not "
            "overexposed");
}

// Markers are seen, but none that is printed on a card.
[[noreturn]] void RefuseOtherMarkers(const std::vector<SeenMarker>& markers,
                                     const std::vector<Card>& cards) {
  if (std::none_of(markers.begin(), markers.end(), IsLocated)) RefuseMarkers(markers);
  std::string seen, names;
  for (const SeenMarker& marker : markers)
    seen += (seen.empty() ? "" : ", ") + std::to_string(marker.id);
  for (const Card& card : cards) names += (names.empty() ? "" : " or ") + card.name;
  throw Refused(Reason::kNoScale,
                "scale: markers are seen (" + seen + "), but none of the card " + names +
                    "; if they are loose ones, give --marker-mm; if they are another card's, "
                    "--card FILE");
}

SheetProblem LooseProblem(const std::vector<SeenMarker>& markers,
                          double side_mm,
                          const CameraKnowledge& camera) {
  SheetProblem problem;
  problem.side_mm = side_mm;
  problem.knowledge = camera;
  for (const SeenMarker& marker : markers) {
    if (!IsLocated(marker)) continue;
    problem.squares.push_back(
        {marker.corners_px, std::hypot(marker.corner_sigma_px, kPaperSigmaPx), std::nullopt});
  }
  if (problem.squares.empty()) RefuseMarkers(markers);
  return problem;
}

SheetProblem CardProblem(const std::vector<SeenMarker>& markers,
                         const Card& card,
                         const CameraKnowledge& camera) {
  SheetProblem problem;
  problem.side_mm = card.marker_mm;
  problem.spread_sigma_mm = kInkSpreadMm;
  problem.knowledge = camera;
  for (const SeenMarker& marker : markers) {
    const Card::Marker* const printed = card.Find(marker.id);
    if (!IsLocated(marker) || printed == nullptr) continue;
    problem.squares.push_back({marker.corners_px,
                               std::hypot(marker.corner_sigma_px, kPaperSigmaPx),
                               card.MarkerCorners(*printed)});
  }
  if (problem.squares.empty()) RefuseMarkers(markers);
  return problem;
}

Card Scaled(Card card, double print_scale) {
  card.marker_mm *= print_scale;
  for (Card::Marker& marker : card.markers) marker.centre_mm *= print_scale;
  for (auto& area : card.print_mm) {
    for (double& value : area) value *= print_scale;
  }
  return card;
}

// Markers of the card, each of which is seen once: two of the same number mean a second sheet.
std::vector<SeenMarker> MarkersOf(const Card& card, const std::vector<SeenMarker>& markers) {
  std::vector<SeenMarker> own;
  for (const SeenMarker& marker : markers) {
    const auto same = [&](const SeenMarker& other) { return other.id == marker.id; };
    if (card.Find(marker.id) != nullptr && std::count_if(markers.begin(), markers.end(), same) == 1)
      own.push_back(marker);
  }
  return own;
}

// Leaves out markers that lie where the others say they cannot: misread, or on a fold.
std::vector<SeenMarker> WithoutMisplaced(std::vector<SeenMarker> markers,
                                         const ProblemFrom& problem) {
  constexpr size_t kEnough = 4;       // fewer cannot outvote one
  constexpr double kMisplacedPx = 4;  // paper that is merely bent stays below
  for (;;) {
    std::erase_if(markers, [](const SeenMarker& marker) { return !IsLocated(marker); });
    if (markers.size() < kEnough) return markers;
    const std::vector<double> rms = SolveSheet(problem(markers)).square_rms_px;
    const auto worst = std::max_element(rms.begin(), rms.end());
    if (*worst < kMisplacedPx) return markers;
    markers.erase(markers.begin() + (worst - rms.begin()));
  }
}

ScaleResult SolveCard(const Photo& photo,
                      const ScaleOptions& options,
                      const Card& printed,
                      const std::vector<SeenMarker>& seen) {
  const Card card = Scaled(printed, options.print_scale);
  const CameraKnowledge camera = KnowCamera(photo, options.camera);
  const ProblemFrom problem = [&](const std::vector<SeenMarker>& markers) {
    return CardProblem(markers, card, camera);
  };
  return Solve(photo, options, WithoutMisplaced(MarkersOf(card, seen), problem), problem);
}

std::vector<Card> BuiltInCards() { return {BuiltInCard(Paper::kA4), BuiltInCard(Paper::kLetter)}; }

}  // namespace

ScaleResult ScaleFromLooseMarkers(const Photo& photo, const ScaleOptions& options) {
  const std::vector<SeenMarker> markers =
      FindMarkers(photo.grey(), SrgbToneCurve(), MarkerEffort::kThorough);
  const CameraKnowledge camera = KnowCamera(photo, options.camera);
  return Solve(photo, options, markers, [&](const std::vector<SeenMarker>& seen) {
    return LooseProblem(seen, *options.marker_mm, camera);
  });
}

ScaleResult ScaleFromCard(const Photo& photo, const ScaleOptions& options) {
  const std::vector<Card> cards =
      *options.card == "default" ? BuiltInCards() : std::vector<Card>{ReadCard(*options.card)};
  const std::vector<SeenMarker> markers =
      FindMarkers(photo.grey(), SrgbToneCurve(), MarkerEffort::kThorough);
  const std::optional<Card> card = CardInView(cards, markers);
  if (!card) RefuseOtherMarkers(markers, cards);
  return SolveCard(photo, options, *card, markers);
}

std::optional<ScaleResult> ScaleFromCardIfSeen(const Photo& photo, const ScaleOptions& options) {
  // Two markers that fit the layout this well are no coincidence.
  constexpr size_t kMinMarkers = 2;
  constexpr double kFitsPx = 2;
  const std::vector<SeenMarker> markers =
      FindMarkers(photo.grey(), SrgbToneCurve(), MarkerEffort::kQuick);
  const std::optional<Card> card = CardInView(BuiltInCards(), markers);
  if (!card || MarkersOf(*card, markers).size() < kMinMarkers) return std::nullopt;
  ScaleResult result = SolveCard(photo, options, *card, markers);
  if (result.sheet->square_rms_px.size() < kMinMarkers || result.sheet->rms_px > kFitsPx)
    return std::nullopt;
  return result;
}

}  // namespace bladecurve
