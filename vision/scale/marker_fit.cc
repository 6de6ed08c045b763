// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "vision/image/blurred_step.h"
#include "vision/image/robust_statistics.h"
#include "vision/scale/marker_model.h"
#include "vision/scale/straight_band.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

constexpr size_t kFewestPixels = 20 * kMarkerUnknowns;
constexpr size_t kMostPixels = 6000;  // leave 0.006 px at a noise of 2 grey values

struct MarkerPixel {
  Vector2d place;
  double light;  // linear, 0 to 1
  int cell;
};

Vector2d Straightened(const std::optional<Camera>& camera, const Vector2d& image_px) {
  return camera ? Undistorted(*camera, image_px) : image_px;
}

std::array<Vector2d, 4> StraightCorners(const SeenMarker& marker,
                                        const std::optional<Camera>& camera) {
  std::array<Vector2d, 4> corners;
  for (size_t k = 0; k < 4; ++k) corners[k] = Straightened(camera, marker.corners_px[k]);
  return corners;
}

MarkerFrame FrameOf(const std::array<Vector2d, 4>& corners) {
  MarkerFrame frame{Vector2d::Zero(), 0};
  for (size_t k = 0; k < 4; ++k) {
    frame.middle_px += corners[k] / 4;
    frame.cell_px += (corners[(k + 1) % 4] - corners[k]).norm() / (4 * kMarkerCells);
  }
  return frame;
}

// Where the picture may show the marker with half a cell of paper about it.
cv::Rect BoxAbout(const SeenMarker& marker, double cell_px, const cv::Size& picture) {
  Vector2d low = marker.corners_px[0], high = low;
  for (const Vector2d& corner : marker.corners_px) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Vector2d from = low.array() - cell_px, to = high.array() + cell_px;
  return cv::Rect(cv::Point(static_cast<int>(from.x()), static_cast<int>(from.y())),
                  cv::Point(static_cast<int>(to.x()) + 2, static_cast<int>(to.y()) + 2)) &
         cv::Rect({0, 0}, picture);
}

// Takes this share of what it is asked about, as evenly as the golden ratio spreads it.
class Thinning {
 public:
  explicit Thinning(double share) : share_(share) {}

  bool Takes() {
    constexpr double kGolden = 0.6180339887498949;
    turn_ += kGolden;
    if (turn_ >= 1) turn_ -= 1;
    return turn_ < share_;
  }

 private:
  double share_, turn_ = 0;
};

// The pixels within some sigmas of blur of a border.
std::vector<MarkerPixel> PixelsAtBorders(const cv::Mat& grey,
                                         const ToneCurve& tone,
                                         const cv::Rect& box,
                                         const MarkerFrame& frame,
                                         const MarkerModel& model,
                                         const std::optional<Camera>& camera) {
  constexpr double kSigmas = 2.5;
  constexpr double kBorders = 48;  // sides of cells; about half of them have ink on one side alone
  constexpr double kSure = 0.7;    // of the way to the next line: tilted, cells are not alike
  constexpr int kMostRowsApart = 2;
  const double reach_px = kSigmas * model.total_blur_px(), reach = reach_px / frame.cell_px;
  const double share = static_cast<double>(kMostPixels) / (kBorders * frame.cell_px * 2 * reach_px);
  // Of large markers whole rows are left out, as long as several cross each border.
  const int rows_apart = std::clamp(static_cast<int>(1 / share), 1, kMostRowsApart);
  Thinning thinning(rows_apart * share);
  std::vector<MarkerPixel> pixels;
  for (int y = box.y; y < box.y + box.height; y += rows_apart) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      const Vector2d place = frame.Place(Straightened(camera, Vector2d(x, y)));
      const Vector2d cells = model.InCells(place);
      const double beyond = CellsToLine(cells) - reach;
      if (beyond > 0) {
        x += static_cast<int>(kSure * beyond * frame.cell_px);
      } else if (model.IsNearBorder(cells, reach) && thinning.Takes()) {
        pixels.push_back({place, tone.linear[grey.at<uchar>(y, x)], MarkerModel::CellOf(cells)});
      }
    }
  }
  return pixels;
}

struct Equations {
  MarkerMatrix information = MarkerMatrix::Zero();
  MarkerVector gradient = MarkerVector::Zero();
  double sum_square = 0;
};

// What little is known beforehand keeps in place what overexposed paper hides: its light against
// the retreat. Standard deviations, for light that scatters by a hundredth.
MarkerVector PriorInformation() {
  constexpr double kScatter = 0.01, kRetreatSigma = 2, kPaperSigma = 1;
  MarkerVector prior = MarkerVector::Constant(1e-9);
  prior[kRetreat] = kScatter * kScatter / (kRetreatSigma * kRetreatSigma);
  prior[kPaper] = kScatter * kScatter / (kPaperSigma * kPaperSigma);
  return prior;
}

class MarkerProblem {
 public:
  MarkerProblem(const InkCells& ink, const MarkerFrame& frame, const MarkerVector& start)
      : ink_(ink), frame_(frame), start_(start), prior_(PriorInformation()) {}

  [[nodiscard]] Equations At(const std::vector<MarkerPixel>& pixels, const MarkerVector& at) const {
    const MarkerModel model(ink_, frame_, at);
    Equations equations;
    MarkerVector derivative;
    for (const MarkerPixel& pixel : pixels) {
      const double residual = pixel.light - model.Light(pixel.place, &derivative);
      equations.information.noalias() += derivative * derivative.transpose();
      equations.gradient += residual * derivative;
      equations.sum_square += residual * residual;
    }
    const MarkerVector off = start_ - at;
    equations.information.diagonal() += prior_;
    equations.gradient += prior_.cwiseProduct(off);
    equations.sum_square += off.dot(prior_.cwiseProduct(off));
    return equations;
  }

  [[nodiscard]] double cell_px() const { return frame_.cell_px; }

 private:
  const InkCells& ink_;
  const MarkerFrame& frame_;
  MarkerVector start_, prior_;
};

bool Plausible(const MarkerVector& at) {
  return at.allFinite() && at[kBlur] <= kMaxBlurPx && at[kInk] < at[kPaper];
}

struct Minimum {
  MarkerVector at;
  MarkerMatrix information;
};

// Levenberg-Marquardt. Where paper is far beyond white, its light against the retreat comes to rest
// slowly, long after the corners.
Minimum Minimise(const MarkerProblem& problem,
                 const std::vector<MarkerPixel>& pixels,
                 MarkerVector at) {
  constexpr int kMostSteps = 30;
  constexpr double kDonePx = 1e-3, kDoneShare = 0.01;  // of the squares that a step would save
  double damping = 1e-4;
  Equations now = problem.At(pixels, at);
  for (int step = 0; step < kMostSteps && damping < 1e6; ++step) {
    MarkerMatrix damped = now.information;
    damped.diagonal() *= 1 + damping;
    const MarkerVector change = damped.ldlt().solve(now.gradient);
    MarkerVector next = at + change;
    next[kBlur] = std::max(next[kBlur], kMinBlurPx);
    const double moved_px = change.head<kHomography>().cwiseAbs().maxCoeff() * problem.cell_px();
    if (moved_px < kDonePx && change.dot(now.gradient) < kDoneShare * now.sum_square)
      return {Plausible(next) ? next : at, now.information};
    const std::optional<Equations> there =
        Plausible(next) ? std::optional(problem.At(pixels, next)) : std::nullopt;
    if (!there || there->sum_square > now.sum_square) {
      damping = std::max(10 * damping, 1e-3);
      continue;
    }
    at = next;
    now = *there;
    damping *= 0.1;
  }
  return {at, now.information};
}

// How the pixels agree with a fit, cell by cell.
class Agreement {
 public:
  Agreement(const std::vector<MarkerPixel>& pixels, const MarkerModel& model) {
    constexpr double kPlainWhite = 0.05;
    MarkerVector derivative;
    for (const MarkerPixel& pixel : pixels) {
      Cell& cell = cells_[static_cast<size_t>(pixel.cell)];
      const double light = model.Light(pixel.place, &derivative);
      const double residual = pixel.light - light;
      if (light >= 1 && residual > -kPlainWhite) continue;  // says nothing
      cell.sum_square += residual * residual;
      cell.score += residual * derivative;
      ++cell.count;
    }
  }

  // Without the cells that something lies over: they fit far worse than the typical one.
  [[nodiscard]] std::vector<MarkerPixel> Uncovered(std::vector<MarkerPixel> pixels) const {
    constexpr double kFarWorse = 9;  // of mean squares
    std::vector<double> means;
    for (const Cell& cell : cells_) {
      if (cell.count > 0) means.push_back(cell.sum_square / cell.count);
    }
    if (means.empty()) return {};
    const double most = kFarWorse * Median(std::move(means));
    std::erase_if(pixels, [&](const MarkerPixel& pixel) {
      const Cell& cell = cells_[static_cast<size_t>(pixel.cell)];
      return cell.sum_square > most * cell.count;
    });
    return pixels;
  }

  // Of the light that the pixels differ by, most is the pattern's.
  [[nodiscard]] bool Explains(const std::vector<MarkerPixel>& pixels) const {
    constexpr double kMostLeft = 0.1;
    double sum = 0, square = 0, left = 0;
    for (const MarkerPixel& pixel : pixels) {
      sum += pixel.light;
      square += pixel.light * pixel.light;
    }
    for (const Cell& cell : cells_) left += cell.sum_square;
    return left < kMostLeft * (square - sum * sum / static_cast<double>(pixels.size()));
  }

  // Sandwich estimate with the cells as clusters: within them the noise may be correlated, and what
  // the model lacks is alike.
  [[nodiscard]] MarkerMatrix Covariance(const MarkerMatrix& information) const {
    MarkerMatrix middle = MarkerMatrix::Zero();
    double cells = 0;
    for (const Cell& cell : cells_) {
      middle += cell.score * cell.score.transpose();
      cells += cell.count > 0 ? 1 : 0;
    }
    const MarkerMatrix inverse = information.ldlt().solve(MarkerMatrix::Identity());
    const double correction = cells / std::max(1.0, cells - double{kMarkerUnknowns});
    return correction * inverse * middle * inverse;
  }

 private:
  struct Cell {
    double sum_square = 0;
    int count = 0;
    MarkerVector score = MarkerVector::Zero();
  };
  std::array<Cell, MarkerModel::kCellsAcross * MarkerModel::kCellsAcross> cells_;
};

// Good to the rounding of single precision, which serves for a start.
Eigen::Matrix<double, kHomography, 1> HomographyFrom(const std::array<Vector2d, 4>& corners,
                                                     const MarkerFrame& frame) {
  std::array<cv::Point2f, 4> places, cells;
  for (size_t k = 0; k < 4; ++k) {
    const Vector2d place = frame.Place(corners[k]), cell = CornerInCells(static_cast<int>(k));
    places[k] = {static_cast<float>(place.x()), static_cast<float>(place.y())};
    cells[k] = {static_cast<float>(cell.x()), static_cast<float>(cell.y())};
  }
  const cv::Matx33d homography = cv::getPerspectiveTransform(places.data(), cells.data());
  return Eigen::Map<const Eigen::Matrix<double, kHomography, 1>>(homography.val);
}

// Some of the light in a box.
std::vector<double> SampleLight(const cv::Mat& grey, const ToneCurve& tone, const cv::Rect& box) {
  constexpr double kSamples = 1000;
  Thinning thinning(kSamples / box.area());
  std::vector<double> light;
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      if (thinning.Takes()) light.push_back(tone.linear[grey.at<uchar>(y, x)]);
    }
  }
  return light;
}

// Paper and ink by the lightest and darkest tenth; paper that is plain white is beyond it.
MarkerVector StartFrom(const std::array<Vector2d, 4>& corners,
                       const MarkerFrame& frame,
                       double blur_px,
                       const std::vector<double>& light) {
  constexpr double kDarkest = 0.1, kLightest = 0.9, kWhite = 0.98, kBeyond = 1.3;
  MarkerVector start = MarkerVector::Zero();
  start.head<kHomography>() = HomographyFrom(corners, frame);
  start[kBlur] = blur_px;
  start[kInk] = SampleQuantile(light, kDarkest);
  const double bright = SampleQuantile(light, kLightest);
  start[kPaper] = bright > kWhite ? kBeyond : bright;
  return start;
}

std::optional<SeenMarker> Placed(const SeenMarker& start,
                                 const MarkerVector& at,
                                 const MarkerMatrix& covariance,
                                 const MarkerFrame& frame,
                                 const std::optional<Camera>& camera) {
  constexpr double kMostBlurs = 2;  // overexposed, a side is seen by its foot alone
  SeenMarker marker = start;
  double variance = 0;
  for (size_t k = 0; k < 4; ++k) {
    const MarkerCorner corner = CornerOf(at, static_cast<int>(k));
    const Vector2d straight = frame.Pixel(corner.place);
    marker.corners_px[k] = camera ? Distorted(*camera, straight) : straight;
    const Eigen::Matrix2d own = corner.jacobian *
                                covariance.topLeftCorner<kHomography, kHomography>() *
                                corner.jacobian.transpose();
    variance += own.trace() * frame.cell_px * frame.cell_px / 8;
    const double moved = (marker.corners_px[k] - start.corners_px[k]).norm();
    if (moved > 1 + kMostBlurs * std::sqrt(TotalBlurVariance(start.blur_px))) return std::nullopt;
  }
  marker.corner_sigma_px = std::sqrt(variance);
  marker.overexposed = at[kPaper] > 1;
  return marker;
}

}  // namespace

std::optional<SeenMarker> FitMarker(const cv::Mat& grey,
                                    const ToneCurve& tone,
                                    const SeenMarker& start,
                                    const std::optional<Camera>& camera) {
  constexpr int kMostLooks = 4;
  const std::array<Vector2d, 4> corners = StraightCorners(start, camera);
  const MarkerFrame frame = FrameOf(corners);
  const cv::Rect box = BoxAbout(start, frame.cell_px, grey.size());
  if (box.empty()) return std::nullopt;
  const InkCells ink = InkCellsOf(start.id);
  const MarkerVector first = StartFrom(corners, frame, start.blur_px, SampleLight(grey, tone, box));
  std::vector<MarkerPixel> pixels =
      PixelsAtBorders(grey, tone, box, frame, MarkerModel(ink, frame, first), camera);
  const auto enough = std::max<size_t>(kFewestPixels, pixels.size() * 4 / 5);
  const MarkerProblem problem(ink, frame, first);
  MarkerVector at = first;
  for (int look = 0; look < kMostLooks && pixels.size() >= enough; ++look) {
    const Minimum minimum = Minimise(problem, pixels, at);
    at = minimum.at;
    const Agreement agreement(pixels, MarkerModel(ink, frame, at));
    std::vector<MarkerPixel> uncovered = agreement.Uncovered(pixels);
    if (uncovered.size() == pixels.size()) {
      if (!agreement.Explains(pixels)) return std::nullopt;
      return Placed(start, at, agreement.Covariance(minimum.information), frame, camera);
    }
    pixels = std::move(uncovered);
  }
  return std::nullopt;
}

}  // namespace bladecurve
