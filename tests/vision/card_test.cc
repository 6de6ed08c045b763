// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scale/card.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "process_folder.h"
#include "vision/image/tone_curve.h"
#include "vision/photo/photo.h"
#include "vision/photo/png_writer.h"
#include "vision/refused.h"
#include "vision/scale/card_drawing.h"
#include "vision/scale/scale.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

uchar Stored(double light) {
  const double v = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return cv::saturate_cast<uchar>(255 * v);
}

// The card as a camera straight above would see it: grey ink on grey paper, blurred in linear
// light.
cv::Mat Photographed(const Card& card, double dpi) {
  const cv::Mat print = CardPicture(DrawCard(card), dpi);
  const ToneCurve tone = SrgbToneCurve();
  cv::Mat light(print.size(), CV_32FC1);
  for (int y = 0; y < print.rows; ++y) {
    for (int x = 0; x < print.cols; ++x)
      light.at<float>(y, x) = 0.04F + 0.76F * tone.linear[print.at<uchar>(y, x)];
  }
  cv::GaussianBlur(light, light, {}, 1.0);
  cv::Mat picture(print.size(), CV_8UC1);
  for (int y = 0; y < print.rows; ++y) {
    for (int x = 0; x < print.cols; ++x) picture.at<uchar>(y, x) = Stored(light.at<float>(y, x));
  }
  return picture;
}

Photo Save(const cv::Mat& picture, const std::string& name) {
  const fs::path path = ProcessFolder() / name;
  WritePng(path, picture);
  return Photo::Load(path);
}

// Centre of a pixel is a whole number, the sheet's corner is the picture's.
Eigen::Vector2d PixelOf(const Card& card, const Eigen::Vector2d& mm, double dpi) {
  const double px_per_mm = dpi / 25.4;
  return {mm.x() * px_per_mm - 0.5, (card.height_mm - mm.y()) * px_per_mm - 0.5};
}

double WorstLengthError(const Card& card, const PlaneMap& map, double dpi) {
  double worst = 0;
  for (const double x : {50.0, 150.0}) {
    for (const double y : {60.0, 150.0}) {
      const Eigen::Vector2d from(x, y), to(x + 80, y - 40);
      const double length = (map.PlaneFromImage(PixelOf(card, to, dpi)) -
                             map.PlaneFromImage(PixelOf(card, from, dpi)))
                                .norm();
      worst = std::max(worst, std::abs(length - (to - from).norm()));
    }
  }
  return worst;
}

TEST(BuiltInCard, HasRoomForInstrumentsAndMarkersOfItsOwn) {
  std::set<int> ids;
  for (const Paper paper : {Paper::kA4, Paper::kLetter}) {
    const Card card = BuiltInCard(paper);
    for (const Card::Marker& marker : card.markers) {
      EXPECT_TRUE(ids.insert(marker.id).second) << marker.id;
      for (const Eigen::Vector2d& corner : card.MarkerCorners(marker)) {
        EXPECT_GE(corner.x(), 6.4) << "printers leave a rim blank";
        EXPECT_LE(corner.x(), card.width_mm - 6.4);
        EXPECT_GE(corner.y(), 6.4);
        EXPECT_LE(corner.y(), card.height_mm - 6.4);
      }
    }
    EXPECT_GE(std::hypot(card.width_mm - 48, card.height_mm - 48), 230);
  }
}

TEST(CardText, ReadsBackTheSame) {
  const Card card = BuiltInCard(Paper::kLetter);
  const fs::path path = ProcessFolder() / "letter.json";
  std::ofstream(path) << CardText(card);
  EXPECT_EQ(CardText(ReadCard(path)), CardText(card));
  std::ofstream(path)
      << R"({"format":"bladecurve-card/1","width_mm":1,"height_mm":-1,"marker_mm":1})";
  EXPECT_THROW(static_cast<void>(ReadCard(path)), std::invalid_argument);
}

TEST(CardPdf, ListsWhereEveryObjectStarts) {
  const std::string pdf = CardPdf(DrawCard(BuiltInCard(Paper::kA4)));
  const size_t table = pdf.rfind("xref\n0 6\n");
  ASSERT_NE(table, std::string::npos);
  for (int object = 1; object <= 5; ++object) {
    const size_t offset = std::stoul(pdf.substr(table + 9 + 20 * static_cast<size_t>(object), 10));
    EXPECT_EQ(pdf.substr(offset, 7), std::to_string(object) + " 0 obj");
  }
  EXPECT_EQ(std::stoul(pdf.substr(pdf.rfind("startxref\n") + 10)), table);
}

TEST(FindScale, ReadsThePrintedCardExactly) {
  constexpr double kDpi = 150;
  for (const Paper paper : {Paper::kA4, Paper::kLetter}) {
    const Card card = BuiltInCard(paper);
    ScaleOptions options;
    options.plane_height_mm = 0;
    const ScaleResult result =
        FindScale(Save(Photographed(card, kDpi), card.name + ".png"), options);
    ASSERT_TRUE(result.map.has_value());
    EXPECT_EQ(result.map->source(), "card");
    EXPECT_EQ(result.markers.size(), card.markers.size());
    EXPECT_LT(WorstLengthError(card, *result.map, kDpi), 0.01) << card.name;  // mm
    EXPECT_TRUE(result.map->warnings().empty()) << result.map->warnings().front();
  }
}

TEST(FindScale, ReadsAPartlyCoveredCard) {
  constexpr double kDpi = 150;
  const Card card = BuiltInCard(Paper::kA4);
  cv::Mat picture = Photographed(card, kDpi);
  cv::rectangle(picture, {0, 0, picture.cols / 3, picture.rows}, cv::Scalar(90), cv::FILLED);
  const ScaleResult result = FindScale(Save(picture, "covered.png"), {});
  ASSERT_TRUE(result.map.has_value());
  EXPECT_LT(WorstLengthError(card, *result.map, kDpi), 0.02);
}

TEST(FindScale, TakesAMeasuredCheckBarIntoAccount) {
  constexpr double kDpi = 150;
  const Card card = BuiltInCard(Paper::kA4);
  const Photo photo = Save(Photographed(card, kDpi), "scaled.png");
  ScaleOptions options;
  options.card = "default";
  const double plain = FindScale(photo, options).map->JacobianAt({800, 600}).col(0).norm();
  options.print_scale = 0.97;
  EXPECT_NEAR(
      FindScale(photo, options).map->JacobianAt({800, 600}).col(0).norm() / plain, 0.97, 1e-4);
}

TEST(FindScale, RefusesBlankPaperAndContradictions) {
  const Photo blank = Save(cv::Mat(300, 400, CV_8UC1, cv::Scalar(180)), "blank.png");
  try {
    static_cast<void>(FindScale(blank, {}));
    FAIL() << "a scale from nothing";
  } catch (const Refused& refused) {
    EXPECT_EQ(refused.reason(), Reason::kNoScale);
  }
  ScaleOptions both;
  both.dpi = 300;
  both.mm_per_px = 0.1;
  EXPECT_THROW(static_cast<void>(FindScale(blank, both)), std::invalid_argument);
  ScaleOptions dpi;
  dpi.dpi = 254;
  EXPECT_NEAR(FindScale(blank, dpi).map->PlaneFromImage({100, 0}).x(), 10, 1e-12);
}

}  // namespace
}  // namespace bladecurve
