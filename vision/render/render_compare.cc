// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/render/render_compare.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/render/render_coverage.h"

namespace bladecurve {
namespace {

using render::CoverageGrid;
using render::PixelKernel;
using render::Polygon;
using render::Ring;

constexpr double kWindowPx = 40;  // of the edge at a time: levels change slowly along a blade
constexpr double kReachPx =
    6;  // on either side: less than a bevel is wide, four times the widest blur that is tried
constexpr double kBladePx = 40;  // depth of the blade that is drawn; beyond the reach and the blur

// A stretch of the edge and the pixels around it.
struct Window {
  std::vector<Eigen::Vector2d> edge;
  cv::Rect box;
};

struct Fit {
  double shift_px = 0, squares = 0, contrast = 0;
  int pixels = 0;
};

std::vector<Window> CutIntoWindows(const std::vector<Eigen::Vector2d>& edge,
                                   const cv::Size& picture) {
  std::vector<Window> windows;
  std::vector<Eigen::Vector2d> piece;
  double length = 0;
  for (const Eigen::Vector2d& p : edge) {
    if (!piece.empty()) length += (p - piece.back()).norm();
    piece.push_back(p);
    if (length < kWindowPx) continue;
    Eigen::Vector2d low = piece.front(), high = low;
    for (const Eigen::Vector2d& q : piece) {
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    const cv::Point top_left(static_cast<int>(std::floor(low.x() - kReachPx)),
                             static_cast<int>(std::floor(low.y() - kReachPx)));
    const cv::Point bottom_right(static_cast<int>(std::ceil(high.x() + kReachPx)) + 1,
                                 static_cast<int>(std::ceil(high.y() + kReachPx)) + 1);
    const cv::Rect box(top_left, bottom_right);
    if ((box & cv::Rect(cv::Point(0, 0), picture)) == box) windows.push_back({piece, box});
    piece = {p};
    length = 0;
  }
  return windows;
}

// The blade beside the window's edge, which is prolonged at both ends so that they lie out of
// sight.
Polygon BladeBeside(const Window& window, double shift_px, double side) {
  const Eigen::Vector2d along = (window.edge.back() - window.edge.front()).normalized();
  const Eigen::Vector2d inwards = side * Eigen::Vector2d(along.y(), -along.x());
  Ring ring = {window.edge.front() - kBladePx * along};
  ring.insert(ring.end(), window.edge.begin(), window.edge.end());
  ring.push_back(window.edge.back() + kBladePx * along);
  for (Eigen::Vector2d& p : ring) p -= shift_px * inwards;
  ring.push_back(ring.back() + kBladePx * inwards);
  ring.push_back(ring.front() + kBladePx * inwards);
  return {ring};
}

cv::Mat1f Draw(const Window& window, double shift_px, double side, const PixelKernel& kernel) {
  const double halo = kernel.halo_px;
  const CoverageGrid grid{
      .origin_px = Eigen::Vector2d(window.box.x - 0.5 - halo, window.box.y - 0.5 - halo),
      .step_px = 1.0 / kernel.oversampling,
      .cols = (window.box.width + 2 * kernel.halo_px) * kernel.oversampling,
      .rows = (window.box.height + 2 * kernel.halo_px) * kernel.oversampling};
  return render::IntegratePixels(render::PolygonCoverage(BladeBeside(window, shift_px, side), grid),
                                 kernel);
}

// Signed distance from the window's chord, positive out of the blade, where the pixel lies beside
// the window and near its edge; nothing elsewhere.
std::optional<double> PlaceBeside(const Window& window, const Eigen::Vector2d& p, double side) {
  const Eigen::Vector2d chord = window.edge.back() - window.edge.front();
  const Eigen::Vector2d along = chord.normalized();
  const Eigen::Vector2d from_start = p - window.edge.front();
  const double place = from_start.dot(along);
  const double out = -side * (along.y() * from_start.x() - along.x() * from_start.y());
  if (place < 0 || place > chord.norm() || std::abs(out) > kReachPx) return std::nullopt;
  return out;
}

// One Gauss-Newton step: levels and slopes on both sides and the shift, linear in all but the last.
std::optional<Fit> FitOnce(const cv::Mat1f& light,
                           const Window& window,
                           double shift_px,
                           double side,
                           const PixelKernel& kernel) {
  constexpr double kDelta = 0.1;  // px; the drawing's change is linear over that
  const cv::Mat1f drawn = Draw(window, shift_px, side, kernel);
  const cv::Mat1f change = (Draw(window, shift_px + kDelta, side, kernel) -
                            Draw(window, shift_px - kDelta, side, kernel)) /
                           (2 * kDelta);
  std::vector<Eigen::Matrix<double, 6, 1>> rows;  // the model's five columns and the light
  for (int r = 0; r < window.box.height; ++r) {
    for (int c = 0; c < window.box.width; ++c) {
      const Eigen::Vector2d p(window.box.x + c, window.box.y + r);
      const std::optional<double> out = PlaceBeside(window, p, side);
      if (!out) continue;
      const double blade = drawn(r, c);
      rows.push_back({blade,
                      1 - blade,
                      blade * *out,
                      (1 - blade) * *out,
                      change(r, c),
                      light(window.box.y + r, window.box.x + c)});
    }
  }
  constexpr std::size_t kTooFew = 60;  // pixels: ten to a parameter
  if (rows.size() < kTooFew) return std::nullopt;
  Eigen::MatrixXd model(static_cast<Eigen::Index>(rows.size()), 6);
  for (std::size_t i = 0; i < rows.size(); ++i) model.row(static_cast<Eigen::Index>(i)) = rows[i];
  const Eigen::VectorXd x = model.leftCols<5>().colPivHouseholderQr().solve(model.col(5));
  Fit fit;
  fit.contrast = x[0] - x[1];
  fit.shift_px = shift_px + std::clamp(x[4] / fit.contrast, -1.0, 1.0);
  fit.squares = (model.leftCols<5>() * x - model.col(5)).squaredNorm();
  fit.pixels = static_cast<int>(rows.size());
  return fit;
}

std::optional<Fit> FitWindow(const cv::Mat1f& light,
                             const Window& window,
                             double side,
                             const PixelKernel& kernel) {
  constexpr int kSteps = 4;
  constexpr double kNoContrast = 0.02;  // of full scale: shadows and noise reach that
  std::optional<Fit> fit;
  double shift_px = 0;
  for (int i = 0; i < kSteps; ++i) {
    fit = FitOnce(light, window, shift_px, side, kernel);
    if (!fit || !(std::abs(fit->contrast) > kNoContrast) ||
        std::abs(fit->shift_px) > kReachPx / 2) {
      return std::nullopt;
    }
    shift_px = fit->shift_px;
  }
  return fit;
}

EdgeAgreement Summarise(const std::vector<Fit>& fits, double blur_px) {
  EdgeAgreement agreement;
  agreement.windows = static_cast<int>(fits.size());
  if (fits.empty()) return agreement;
  double sum = 0, squares = 0, relative = 0, pixels = 0;
  for (const Fit& fit : fits) {
    sum += fit.shift_px;
    squares += fit.shift_px * fit.shift_px;
    relative += fit.squares / (fit.contrast * fit.contrast);
    pixels += fit.pixels;
  }
  const double count = static_cast<double>(fits.size());
  agreement.shift_px = sum / count;
  agreement.spread_px =
      std::sqrt(std::max(0.0, squares / count - agreement.shift_px * agreement.shift_px));
  agreement.blur_px = blur_px;
  agreement.residual = std::sqrt(relative / pixels);
  return agreement;
}

cv::Mat1f LinearLight(const cv::Mat& grey, const ToneCurve& tone) {
  cv::Mat1f light;
  cv::LUT(grey, cv::Mat(1, 256, CV_32F, const_cast<float*>(tone.linear.data())), light);
  return light;
}

}  // namespace

EdgeAgreement CompareDrawnEdge(const cv::Mat& grey,
                               const ToneCurve& tone,
                               const std::vector<Eigen::Vector2d>& edge_px,
                               bool blade_on_left) {
  const cv::Mat1f light = LinearLight(grey, tone);
  const double side = blade_on_left ? 1 : -1;
  const std::vector<Window> windows = CutIntoWindows(edge_px, grey.size());
  EdgeAgreement best;
  for (const double blur_px : {0.5, 0.65, 0.8, 1.0, 1.25, 1.6}) {
    const PixelKernel kernel = render::MakePixelKernel(blur_px);
    std::vector<Fit> fits;
    for (const Window& window : windows) {
      if (const std::optional<Fit> fit = FitWindow(light, window, side, kernel))
        fits.push_back(*fit);
    }
    const EdgeAgreement agreement = Summarise(fits, blur_px);
    const bool more = agreement.windows > best.windows;
    if (more || (agreement.windows == best.windows && agreement.residual < best.residual))
      best = agreement;
  }
  return best;
}

}  // namespace bladecurve
