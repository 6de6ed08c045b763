// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/marker_corners.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <random>

#include "vision/image/tone_curve.h"
#include "vision/scale/marker_detector.h"
#include "vision/scale/marker_fit.h"
#include "vision/square_images.h"

namespace bladecurve {
namespace {

SquareImage MarkerImage(double side_px) {
  SquareImage image;
  image.side_px = side_px;
  image.marker = 7;
  return image;
}

double CornerRms(SquareImage image, const ToneCurve& tone, int draws) {
  std::mt19937 random(11);
  double square = 0;
  for (int i = 0; i < draws; ++i) {
    image.angle_rad = Uniform(&random, -0.7, 0.7);
    const cv::Mat grey = Draw(image, &random);
    RoughMarker rough{*image.marker, Corners(image)};
    for (auto& corner : rough.corners_px)
      corner += Eigen::Vector2d(Uniform(&random, -1.5, 1.5), Uniform(&random, -1.5, 1.5));
    const SeenMarker marker = LocateMarkerCorners(grey, tone, rough, {2.5, std::nullopt});
    for (size_t k = 0; k < 4; ++k)
      square += (marker.corners_px[k] - Corners(image)[k]).squaredNorm() / (8 * draws);
  }
  return std::sqrt(square);
}

TEST(LocateMarkerCorners, AreGoodToAHundredthOfAPixel) {
  for (const double blur : {0.8, 1.5}) {
    SquareImage image = MarkerImage(150);
    image.blur_px = blur;
    EXPECT_LT(CornerRms(image, LinearToneCurve(), 10), 0.01) << "blur " << blur;
  }
}

// On a light table, the label that it is printed on is a darker square as well.
TEST(DetectMarkers, SeesAMarkerOnALabelWithANarrowMarginOnABrighterGround) {
  constexpr double kSidePx = 120, kGround = 245, kPaper = 215, kSamePx = 2;
  for (const double margin : {0.1, 0.17, 0.3}) {
    std::mt19937 random(3);
    SquareImage image = MarkerImage(kSidePx);
    image.bright = kPaper / 255;
    cv::Mat grey = Draw(image, &random);
    const double half_px = (0.5 + margin) * kSidePx;
    for (int y = 0; y < grey.rows; ++y) {
      for (int x = 0; x < grey.cols; ++x) {
        const Eigen::Vector2d place =
            Eigen::Rotation2Dd(-image.angle_rad) * (Eigen::Vector2d(x, y) - image.centre_px);
        if (place.cwiseAbs().maxCoeff() > half_px) grey.at<uchar>(y, x) = kGround;
      }
    }
    const std::vector<RoughMarker> markers = DetectMarkers(grey);
    ASSERT_EQ(markers.size(), 1U) << margin;
    EXPECT_EQ(markers[0].id, image.marker);
    EXPECT_LT((markers[0].corners_px[0] - Corners(image)[0]).norm(), kSamePx);
  }
}

using Dim = std::function<cv::Mat(const cv::Mat& grey)>;

// Rms of the corners of markers of 60 px.
double SmallMarkerRms(double blur_px, const Dim& dim) {
  constexpr int kDraws = 20;
  std::mt19937 random(19);
  SquareImage image = MarkerImage(60);
  image.blur_px = blur_px;
  double squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    image.angle_rad = Uniform(&random, -0.7, 0.7);
    image.centre_px = {130 + Uniform(&random, -1, 1), 130 + Uniform(&random, -1, 1)};
    const cv::Mat grey = dim(Draw(image, &random));
    RoughMarker rough{*image.marker, Corners(image)};
    for (Eigen::Vector2d& corner : rough.corners_px)
      corner += Eigen::Vector2d(Uniform(&random, -1, 1), Uniform(&random, -1, 1));
    const SeenMarker marker =
        LocateMarkerCorners(grey, LinearToneCurve(), rough, {2, std::nullopt});
    EXPECT_TRUE(std::isfinite(marker.corner_sigma_px)) << "draw " << i;
    for (size_t k = 0; k < 4; ++k)
      squares += (marker.corners_px[k] - Corners(image)[k]).squaredNorm() / (8 * kDraws);
  }
  return std::sqrt(squares);
}

constexpr double kDemandedPx = 0.01;

// Sides fitted one by one leave 0.012 px at a blur of 1.5 px.
TEST(LocateMarkerCorners, SmallMarkersAreGoodToAHundredthOfAPixel) {
  for (const double blur : {1.0, 1.5})
    EXPECT_LT(SmallMarkerRms(blur, [](const cv::Mat& grey) { return grey; }), kDemandedPx)
        << "blur " << blur;
}

// A lamp at the side: a tenth less light over the marker.
TEST(LocateMarkerCorners, LightThatFallsOffMovesNoCorner) {
  const auto dim = [](const cv::Mat& grey) {
    cv::Mat dimmed = grey.clone();
    for (int y = 0; y < grey.rows; ++y) {
      for (int x = 0; x < grey.cols; ++x) {
        const double lamp = 1 - 0.1 * (x - 130) / 60.0;
        dimmed.at<uchar>(y, x) = cv::saturate_cast<uchar>(lamp * grey.at<uchar>(y, x));
      }
    }
    return dimmed;
  };
  EXPECT_LT(SmallMarkerRms(1.0, dim), kDemandedPx);
}

// Mean distance from the middle of the located corners less that of the true ones, px.
struct Growth {
  double mean_px = 0;
  bool overexposed = true;
};

Growth GrowthOfMarker(SquareImage image) {
  constexpr int kDraws = 5;
  std::mt19937 random(23);
  Growth growth;
  for (int i = 0; i < kDraws; ++i) {
    image.angle_rad = Uniform(&random, -0.7, 0.7);
    const SeenMarker marker = LocateMarkerCorners(Draw(image, &random),
                                                  LinearToneCurve(),
                                                  {*image.marker, Corners(image)},
                                                  {2, std::nullopt});
    EXPECT_TRUE(std::isfinite(marker.corner_sigma_px)) << "paper " << image.bright << " draw " << i;
    for (size_t k = 0; k < 4; ++k) {
      growth.mean_px += ((marker.corners_px[k] - image.centre_px).norm() -
                         (Corners(image)[k] - image.centre_px).norm()) /
                        (4 * kDraws);
    }
    growth.overexposed &= marker.overexposed;
  }
  return growth;
}

constexpr double kClosePx = 0.02;

SquareImage OnPaper(double light, double side_px) {
  SquareImage image = MarkerImage(side_px);
  image.blur_px = 0.7;
  image.bright = light;
  return image;
}

// By its sides alone, taken for white, paper of 1.6 times its light makes markers look 0.4 px
// smaller on every side.
TEST(LocateMarkerCorners, PaperBrighterThanWhiteShrinksNoMarker) {
  for (const double paper : {1.2, 1.6, 2.2, 4.0, 8.0}) {
    for (const double side_px : {80.0, 140.0}) {
      const Growth growth = GrowthOfMarker(OnPaper(paper, side_px));
      EXPECT_NEAR(growth.mean_px, 0, kClosePx) << paper << ", side " << side_px;
      EXPECT_TRUE(growth.overexposed) << paper << ", side " << side_px;
    }
  }
  EXPECT_FALSE(GrowthOfMarker(OnPaper(0.8, 140)).overexposed);
}

// Stored values of gamma 2.2 taken for light move each side 0.6 px into the ink.
TEST(LocateMarkerCorners, AreRightThoughTheToneCurveIsNot) {
  SquareImage image = OnPaper(0.8, 140);
  image.dark = 0.04;
  image.encoding_gamma = 2.2;
  EXPECT_NEAR(GrowthOfMarker(image).mean_px, 0, kClosePx);
}

// Ink that has run by a third of a pixel to all sides; half as much again across the diagonals.
TEST(LocateMarkerCorners, InkThatHasRunChangesNoSize) {
  constexpr int kFiner = 6, kRunPx = 2;
  std::mt19937 random(29);
  SquareImage fine = MarkerImage(140 * kFiner);
  fine.width = fine.height = 260 * kFiner;
  fine.centre_px = {130 * kFiner, 130 * kFiner};
  fine.blur_px = 0.5;
  fine.noise = 0;
  cv::Mat grey = Draw(fine, &random);
  const cv::Mat disc =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kRunPx + 1, 2 * kRunPx + 1});
  cv::erode(grey, grey, disc);
  cv::GaussianBlur(grey, grey, {}, 0.8 * kFiner);
  cv::resize(grey, grey, {}, 1.0 / kFiner, 1.0 / kFiner, cv::INTER_AREA);
  const auto located = [&](const Eigen::Vector2d& corner) -> Eigen::Vector2d {
    return (corner + Eigen::Vector2d(0.5, 0.5)) / kFiner - Eigen::Vector2d(0.5, 0.5);
  };
  std::array<Eigen::Vector2d, 4> truth = Corners(fine);
  for (Eigen::Vector2d& corner : truth) corner = located(corner);
  const SeenMarker marker =
      LocateMarkerCorners(grey, LinearToneCurve(), {*fine.marker, truth}, {2, std::nullopt});
  for (size_t k = 0; k < 4; ++k)
    EXPECT_LT((marker.corners_px[k] - truth[k]).norm(), kClosePx) << "corner " << k;
}

// A plain square has no pattern to tell by.
TEST(LocateMarkerCorners, PaperFarBeyondWhiteLeavesNoPlainSquare) {
  std::mt19937 random(24);
  SquareImage image;
  image.bright = 8;
  const SeenMarker marker = LocateMarkerCorners(
      Draw(image, &random), LinearToneCurve(), {0, Corners(image)}, {2, std::nullopt});
  EXPECT_TRUE(std::isnan(marker.corner_sigma_px));
}

SeenMarker StartOf(const SquareImage& image, int id) {
  SeenMarker start;
  start.id = id;
  start.corners_px = Corners(image);
  start.blur_px = image.blur_px;
  return start;
}

void Cover(const SquareImage& image, double cells, cv::Mat* grey) {
  const double half = cells / 2 * image.side_px / 6;
  const Eigen::Vector2d middle = image.centre_px;
  cv::rectangle(*grey,
                cv::Point2d(middle.x() - half, middle.y() - half),
                cv::Point2d(middle.x() + half, middle.y() + half),
                cv::Scalar(120),
                cv::FILLED);
}

TEST(FitMarker, LeavesOutWhatIsCovered) {
  std::mt19937 random(3);
  const SquareImage image = MarkerImage(150);
  cv::Mat grey = Draw(image, &random);
  Cover(image, 1, &grey);
  const auto fitted =
      FitMarker(grey, LinearToneCurve(), StartOf(image, *image.marker), std::nullopt);
  ASSERT_TRUE(fitted);
  for (size_t k = 0; k < 4; ++k)
    EXPECT_LT((fitted->corners_px[k] - Corners(image)[k]).norm(), kClosePx) << "corner " << k;
  Cover(image, 5, &grey);
  EXPECT_FALSE(FitMarker(grey, LinearToneCurve(), StartOf(image, *image.marker), std::nullopt));
}

int CellsThatDiffer(int id, int other) {
  const auto cells = MarkerCells(id), others = MarkerCells(other);
  return static_cast<int>(cells.size()) -
         std::inner_product(
             cells.begin(), cells.end(), others.begin(), 0, std::plus<>(), std::equal_to<>());
}

// Patterns nearly alike are told apart by whoever decodes the marker.
TEST(FitMarker, TakesNoOtherPattern) {
  constexpr int kAlike = 5;
  std::mt19937 random(3);
  const SquareImage image = MarkerImage(150);
  const cv::Mat grey = Draw(image, &random);
  for (int id = 0; id < 50; ++id) {
    if (id == *image.marker || CellsThatDiffer(id, *image.marker) <= kAlike) continue;
    EXPECT_FALSE(FitMarker(grey, LinearToneCurve(), StartOf(image, id), std::nullopt)) << id;
  }
}

}  // namespace
}  // namespace bladecurve
