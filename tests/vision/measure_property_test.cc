// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// The same scissors, whatever is done to the photograph: turned, mirrored, scaled, exposed
// otherwise, with more noise or without the handles, the measurement says the same within its
// stated uncertainty. On a rendered photograph, and on real and ray-traced ones where they lie
// beside the project.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "path_distance.h"
#include "process_folder.h"
#include "vision/measure.h"
#include "vision/photo/photo.h"
#include "vision/photo/png_writer.h"
#include "vision/photographs_beside.h"
#include "vision/refused.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;
namespace fs = std::filesystem;

// What was done to a picture, and where a point of it went.
struct Change {
  std::string name;
  std::function<cv::Mat(const cv::Mat&)> apply;
  std::function<Vector2d(const Vector2d&, const cv::Size&)> moved;
  double factor = 1;  // of the size
  bool swaps_blades = false;
};

Vector2d Stays(const Vector2d& p, const cv::Size& /*size*/) { return p; }

Change QuarterTurn() {
  return {"quarter turn",
          [](const cv::Mat& picture) {
            cv::Mat turned;
            cv::rotate(picture, turned, cv::ROTATE_90_CLOCKWISE);
            return turned;
          },
          [](const Vector2d& p, const cv::Size& size) {
            return Vector2d(size.height - 1 - p.y(), p.x());
          }};
}

Change HalfTurn() {
  return {"half turn",
          [](const cv::Mat& picture) {
            cv::Mat turned;
            cv::rotate(picture, turned, cv::ROTATE_180);
            return turned;
          },
          [](const Vector2d& p, const cv::Size& size) {
            return Vector2d(size.width - 1 - p.x(), size.height - 1 - p.y());
          }};
}

// About the middle; what comes into the picture from outside is its border.
Change Turned(double degrees) {
  const auto matrix = [degrees](const cv::Size& size) {
    return cv::getRotationMatrix2D(cv::Point2f(static_cast<float>(size.width - 1) / 2,
                                               static_cast<float>(size.height - 1) / 2),
                                   degrees,
                                   1);
  };
  return {"turned by " + std::to_string(static_cast<int>(degrees)),
          [matrix](const cv::Mat& picture) {
            cv::Mat turned;
            cv::warpAffine(picture,
                           turned,
                           matrix(picture.size()),
                           picture.size(),
                           cv::INTER_CUBIC,
                           cv::BORDER_REPLICATE);
            return turned;
          },
          [matrix](const Vector2d& p, const cv::Size& size) {
            const cv::Mat m = matrix(size);
            return Vector2d(
                m.at<double>(0, 0) * p.x() + m.at<double>(0, 1) * p.y() + m.at<double>(0, 2),
                m.at<double>(1, 0) * p.x() + m.at<double>(1, 1) * p.y() + m.at<double>(1, 2));
          }};
}

Change Mirrored() {
  return {"mirrored",
          [](const cv::Mat& picture) {
            cv::Mat mirrored;
            cv::flip(picture, mirrored, 1);
            return mirrored;
          },
          [](const Vector2d& p, const cv::Size& size) {
            return Vector2d(size.width - 1 - p.x(), p.y());
          },
          1,
          true};
}

Change Scaled(double factor) {
  return {"scaled by " + std::to_string(factor).substr(0, 4),
          [factor](const cv::Mat& picture) {
            cv::Mat scaled;
            cv::resize(
                picture, scaled, {}, factor, factor, factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
            return scaled;
          },
          [factor](const Vector2d& p, const cv::Size& /*size*/) -> Vector2d {
            return (factor * (p.array() + 0.5) - 0.5).matrix();
          },
          factor};
}

// In light: one stop is a factor of two before the tone curve.
Change Exposed(double stops) {
  return {"exposed by " + std::to_string(stops).substr(0, 4) + " stops",
          [stops](const cv::Mat& picture) {
            cv::Mat table(1, 256, CV_8UC1);
            for (int value = 0; value < 256; ++value) {
              const double encoded = value / 255.0;
              const double light =
                  encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
              const double more = std::min(1.0, light * std::exp2(stops));
              const double back =
                  more <= 0.0031308 ? 12.92 * more : 1.055 * std::pow(more, 1 / 2.4) - 0.055;
              table.at<uchar>(value) = cv::saturate_cast<uchar>(255 * back);
            }
            cv::Mat exposed;
            cv::LUT(picture, table, exposed);
            return exposed;
          },
          Stays};
}

Change Noisy(double grey) {
  return {"noise of " + std::to_string(static_cast<int>(grey)),
          [grey](const cv::Mat& picture) {
            std::mt19937 random(7);
            std::normal_distribution<double> noise(0, grey);
            cv::Mat noisy = picture.clone();
            for (int row = 0; row < noisy.rows; ++row) {
              uchar* values = noisy.ptr(row);
              for (int k = 0; k < noisy.cols * noisy.channels(); ++k)
                values[k] = cv::saturate_cast<uchar>(values[k] + noise(random));
            }
            return noisy;
          },
          Stays};
}

// Turned and scaled about the middle, on as much ground more as that needs.
class TurnedAndScaled {
 public:
  TurnedAndScaled(double angle_rad, double factor)
      : turn_(factor * Eigen::Rotation2Dd(angle_rad).toRotationMatrix()), factor_(factor) {}

  [[nodiscard]] Vector2d Moved(const Vector2d& p, const cv::Size& size) const {
    return turn_ * (p - Middle(size)) + Middle(Grown(size));
  }

  [[nodiscard]] cv::Mat Apply(const cv::Mat& picture) const {
    constexpr double kLensBlur = 0.5;  // px, of what is reduced
    cv::Mat sharp = picture;
    if (factor_ < 1) {
      const double sigma = kLensBlur * std::sqrt(1 / (factor_ * factor_) - 1) + 1e-3;
      cv::GaussianBlur(picture, sharp, {}, sigma);
    }
    const Vector2d shift = Moved(Vector2d::Zero(), picture.size());
    const cv::Matx23d affine(
        turn_(0, 0), turn_(0, 1), shift.x(), turn_(1, 0), turn_(1, 1), shift.y());
    cv::Mat moved;
    cv::warpAffine(
        sharp, moved, affine, Grown(picture.size()), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    return moved;
  }

  [[nodiscard]] double factor() const { return factor_; }

 private:
  static Vector2d Middle(const cv::Size& size) {
    return {0.5 * (size.width - 1), 0.5 * (size.height - 1)};
  }
  [[nodiscard]] cv::Size Grown(const cv::Size& size) const {
    const Vector2d grown = turn_.cwiseAbs() * Vector2d(size.width, size.height);
    return {static_cast<int>(grown.x()), static_cast<int>(grown.y())};
  }

  Eigen::Matrix2d turn_;
  double factor_;
};

// Turned by any angle, in another size, light and noise.
Change AllAtOnce(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&random](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  const TurnedAndScaled move(uniform(0, 2 * std::numbers::pi), std::exp2(uniform(-0.8, 1)));
  const Change exposed = Exposed(uniform(-1, 0.2)), noisy = Noisy(uniform(0, 4));
  return {"all at once, seed " + std::to_string(seed),
          [=](const cv::Mat& picture) { return noisy.apply(exposed.apply(move.Apply(picture))); },
          [=](const Vector2d& p, const cv::Size& size) { return move.Moved(p, size); },
          move.factor()};
}

Change SmallAndExposed(double factor, double stops) {
  const Change scaled = Scaled(factor), exposed = Exposed(stops);
  return {scaled.name + ", " + exposed.name,
          [=](const cv::Mat& picture) { return exposed.apply(scaled.apply(picture)); },
          scaled.moved,
          factor};
}

// The part of the picture that a line across it leaves, so many blades' lengths behind the pivot.
std::optional<Change> CutBehind(const PhotoMeasurement& seen,
                                double lengths,
                                const cv::Size& size) {
  constexpr int kLeastLeftOut = 20;  // px
  const int axis = std::abs(seen.axis_px.x()) > std::abs(seen.axis_px.y()) ? 0 : 1;
  const double length = (seen.upper_end_px - seen.pivot_px).norm();
  const int extent = axis == 0 ? size.width : size.height;
  const int cut = static_cast<int>(seen.pivot_px[axis] - lengths * length * seen.axis_px[axis]);
  if (cut < kLeastLeftOut || cut > extent - kLeastLeftOut) return std::nullopt;
  const bool keeps_begin = seen.axis_px[axis] < 0;
  cv::Rect kept(cv::Point(), size);
  (axis == 0 ? kept.width : kept.height) = keeps_begin ? cut : extent - cut;
  if (!keeps_begin) (axis == 0 ? kept.x : kept.y) = cut;
  return Change{"cut " + std::to_string(lengths).substr(0, 3) + " lengths behind the pivot",
                [kept](const cv::Mat& picture) { return picture(kept).clone(); },
                [kept](const Vector2d& p, const cv::Size& /*size*/) -> Vector2d {
                  return p - Vector2d(kept.x, kept.y);
                }};
}

// From close behind the joint to where the rings begin.
constexpr std::array kCutsBehind{0.4, 0.8, 1.2, 1.6};

PhotoMeasurement Measure(const cv::Mat& picture, const MeasureOptions& options) {
  const fs::path file = ProcessFolder() / "picture.png";
  WritePng(file, picture);
  return MeasurePhoto(file, options);
}

PhotoMeasurement Measure(const cv::Mat& picture, double mm_per_px, const SceneHints& hints = {}) {
  MeasureOptions options;
  options.scale.mm_per_px = mm_per_px;
  options.hints = hints;
  return Measure(picture, options);
}

std::optional<PhotoMeasurement> MeasureUnlessRefused(const cv::Mat& picture,
                                                     const MeasureOptions& options) {
  try {
    return Measure(picture, options);
  } catch (const Refused&) {
    return std::nullopt;
  }
}

// Three standard deviations of the difference of two measurements, and what resampling may shift.
constexpr double kSigmas = 3;
constexpr double kResamplingPx = 0.1;

// Those that lie beside the path, not beyond its ends.
std::vector<Vector2d> Beside(const std::vector<Vector2d>& path, std::vector<Vector2d> points) {
  const Vector2d from_front = path[1] - path.front();
  const Vector2d from_back = path[path.size() - 2] - path.back();
  points.erase(std::remove_if(points.begin(),
                              points.end(),
                              [&](const Vector2d& p) {
                                return (p - path.front()).dot(from_front) < 0 ||
                                       (p - path.back()).dot(from_back) < 0;
                              }),
               points.end());
  return points;
}

void ExpectSame(const PhotoMeasurement& before,
                const PhotoMeasurement& after,
                const Change& change,
                const cv::Size& size) {
  const Vector2d expected = change.moved(before.pivot_px, size);
  const double pivot_sigma =
      std::hypot(change.factor * before.pivot_sigma_px, after.pivot_sigma_px);
  EXPECT_LT((after.pivot_px - expected).norm(), kSigmas * pivot_sigma + kResamplingPx);
  EXPECT_NEAR(after.theta_rad,
              before.theta_rad,
              kSigmas * std::hypot(before.theta_sigma_rad, after.theta_sigma_rad));
  if (change.swaps_blades) return;
  std::vector<Vector2d> edge;
  for (const Vector2d& p : before.upper_edge_px) edge.push_back(change.moved(p, size));
  EXPECT_LT(
      RmsToPath(Beside(edge, after.upper_edge_px), edge),
      kSigmas * std::hypot(change.factor * before.upper_edge_sigma_px, after.upper_edge_sigma_px) +
          kResamplingPx);
}

struct Look {
  std::string name;
  Backdrop backdrop = Backdrop::kPaper;
  bool in_the_sun = false;
};

constexpr double kMmPerPx = 0.25;

SceneSpec SceneOf(const Look& look) {
  SceneSpec spec;
  spec.width = 1000;
  spec.height = 750;
  spec.camera.mm_per_px = kMmPerPx;
  spec.theta_rad = 24 * std::numbers::pi / 180;
  spec.backdrop = look.backdrop;
  if (look.in_the_sun) {
    spec.light.shadow = 0.7;
    spec.light.shadow_blur_mm = 0.2;
    spec.light.glint = 1.2;
  }
  return spec;
}

class RenderedPhotograph : public ::testing::TestWithParam<Look> {
 protected:
  void SetUp() override {
    picture_ = RenderScene(SceneOf(GetParam())).bgr;
    before_ = Measure(picture_, kMmPerPx);
  }

  void ExpectUnmoved(const Change& change) const {
    SCOPED_TRACE(change.name);
    const PhotoMeasurement after = Measure(change.apply(picture_), kMmPerPx / change.factor);
    ExpectSame(before_, after, change, picture_.size());
  }

  cv::Mat picture_;
  PhotoMeasurement before_;
};

INSTANTIATE_TEST_SUITE_P(Looks,
                         RenderedPhotograph,
                         ::testing::Values(Look{"paper"},
                                           Look{"light_table", Backdrop::kLightTable},
                                           Look{"drape", Backdrop::kDrape},
                                           Look{"cloth", Backdrop::kCloth},
                                           Look{"wood_in_the_sun", Backdrop::kWood, true}),
                         [](const auto& look) { return look.param.name; });

TEST_P(RenderedPhotograph, TurnsWithThePicture) {
  ExpectUnmoved(QuarterTurn());
  ExpectUnmoved(HalfTurn());
  for (const double degrees : {-33.0, 11.0}) ExpectUnmoved(Turned(degrees));
}

TEST_P(RenderedPhotograph, MirrorsWithThePicture) { ExpectUnmoved(Mirrored()); }

TEST_P(RenderedPhotograph, ScalesWithThePicture) {
  for (const double factor : {0.5, 0.7, 1.4}) ExpectUnmoved(Scaled(factor));
}

// Enlarged twice, the picture is so soft that the bevel's inner border may pass for the edge: then
// the result must say that there was another one.
TEST_P(RenderedPhotograph, ScalesOrIsDoubtedWhenEnlargedTwice) {
  const Change change = Scaled(2);
  const PhotoMeasurement after = Measure(change.apply(picture_), kMmPerPx / 2);
  const auto& warnings = after.warnings;
  if (std::find(warnings.begin(), warnings.end(), "upper_edge_ambiguous") != warnings.end()) return;
  ExpectSame(before_, after, change, picture_.size());
}

// Each edge passes the pivot as far off as the other; a shadow taken for one of them does not.
TEST_P(RenderedPhotograph, IsDoubtedWhereOneEdgePassesThePivotFartherOff) {
  const Vector2d across(-before_.axis_px.y(), before_.axis_px.x());
  const double length = (before_.upper_end_px - before_.pivot_px).norm();
  const auto asymmetric = [&](double share) {
    SceneHints hints;
    hints.pivot_px = before_.pivot_px + share * length * across;
    const auto warnings = Measure(picture_, kMmPerPx, hints).warnings;
    return std::find(warnings.begin(), warnings.end(), "blades_asymmetric") != warnings.end();
  };
  EXPECT_FALSE(asymmetric(0.01));
  EXPECT_TRUE(asymmetric(0.03));
}

TEST_P(RenderedPhotograph, KeepsItsMeasuresUnderAnotherExposure) {
  ExpectUnmoved(Exposed(-1));
  ExpectUnmoved(Exposed(0.4));  // a whole stop would clip the paper
}

TEST_P(RenderedPhotograph, KeepsItsMeasuresUnderMoreNoise) { ExpectUnmoved(Noisy(5)); }

TEST_P(RenderedPhotograph, KeepsItsMeasuresWithoutTheHandles) {
  for (const double lengths : kCutsBehind) {
    const std::optional<Change> cut = CutBehind(before_, lengths, picture_.size());
    ASSERT_TRUE(cut) << lengths;
    ExpectUnmoved(*cut);
  }
}

// Photographs that are somebody else's and lie beside the project; and how they are measured.
struct PhotographsBeside {
  std::string folder;
  int longest_px = 0;  // the properties hold at any size, and a test should not take minutes
  MeasureOptions options;

  [[nodiscard]] std::vector<fs::path> Files() const {
    const fs::path all = FolderBeside() / folder;
    std::vector<fs::path> photographs;
    if (!fs::exists(all)) return photographs;
    for (const fs::directory_entry& entry : fs::directory_iterator(all)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".jpg" || extension == ".png") photographs.push_back(entry.path());
    }
    std::sort(photographs.begin(), photographs.end());
    return photographs;
  }

  [[nodiscard]] cv::Mat Picture(const fs::path& file) const {
    const cv::Mat picture = Photo::Load(file).DecodeColour(longest_px);
    const double factor = std::min(1.0, 1.0 * longest_px / std::max(picture.cols, picture.rows));
    cv::Mat small;
    cv::resize(picture, small, {}, factor, factor, cv::INTER_AREA);
    return small;
  }
};

PhotographsBeside RealPhotographs() {
  PhotographsBeside real{"real", 700, {}};
  real.options.scale.mm_per_px = 1;
  return real;
}

// In known views; the markers' size does not matter here.
PhotographsBeside RayTracedPhotographs() {
  PhotographsBeside traced{"rendered", 2000, {}};
  traced.options.scale.marker_mm = 25;
  return traced;
}

using ChangesOf =
    std::function<std::vector<Change>(const PhotoMeasurement& before, const cv::Size& size)>;

// Every changed photograph, of those that are measured, must either be refused or agree: one at the
// edge of what can be seen may tip over, but not into another answer. Of all so large a share must
// agree.
void ExpectAlikeOrRefused(const PhotographsBeside& photographs,
                          const ChangesOf& changes,
                          double least_share) {
  const std::vector<fs::path> files = photographs.Files();
  if (files.empty()) GTEST_SKIP() << "no photographs beside the project";
  int measured = 0, tried = 0, again = 0;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.filename());
    const cv::Mat picture = photographs.Picture(file);
    const auto before = MeasureUnlessRefused(picture, photographs.options);
    if (!before) continue;
    ++measured;
    for (const Change& change : changes(*before, picture.size())) {
      SCOPED_TRACE(change.name);
      ++tried;
      const auto after = MeasureUnlessRefused(change.apply(picture), photographs.options);
      if (!after) continue;
      ExpectSame(*before, *after, change, picture.size());
      ++again;
    }
  }
  EXPECT_GT(measured, static_cast<int>(files.size()) / 2);
  EXPECT_GE(tried, 20);
  EXPECT_GE(again, least_share * tried) << again << " of " << tried;
}

TEST(RealPhotograph, IsMeasuredAlikeOrRefusedWhenTurnedAndMirrored) {
  ExpectAlikeOrRefused(
      RealPhotographs(),
      [](auto&, auto&) {
        return std::vector{QuarterTurn(), HalfTurn(), Mirrored()};
      },
      0.9);
}

TEST(RealPhotograph, IsMeasuredAlikeOrRefusedInAnotherSize) {
  ExpectAlikeOrRefused(
      RealPhotographs(),
      [](auto&, auto&) {
        return std::vector{Scaled(0.7), Scaled(1.4), Scaled(2)};
      },
      0.9);
}

TEST(RealPhotograph, IsMeasuredAlikeOrRefusedUnderAnotherExposureAndMoreNoise) {
  // A whole stop more clips white grounds.
  ExpectAlikeOrRefused(
      RealPhotographs(),
      [](auto&, auto&) {
        return std::vector{Exposed(-1), Exposed(1), Noisy(4)};
      },
      0.75);
}

TEST(RealPhotograph, IsMeasuredAlikeOrRefusedUnderAllAtOnce) {
  ExpectAlikeOrRefused(
      RealPhotographs(),
      [](auto&, auto&) {
        return std::vector{AllAtOnce(1), AllAtOnce(2), AllAtOnce(3)};
      },
      0.85);
}

TEST(RealPhotograph, IsMeasuredAlikeOrRefusedWithoutTheHandles) {
  const auto cuts = [](const PhotoMeasurement& before, const cv::Size& size) {
    std::vector<Change> changes;
    for (const double lengths : kCutsBehind) {
      if (const auto cut = CutBehind(before, lengths, size)) changes.push_back(*cut);
    }
    return changes;
  };
  ExpectAlikeOrRefused(RealPhotographs(), cuts, 0.8);
}

// Brighter, a tip's shadow is as pale as the ground; smaller, it is hardly wider than the tip.
TEST(RayTracedPhotograph, IsMeasuredAlikeUnderAnotherExposureAndSmaller) {
  ExpectAlikeOrRefused(
      RayTracedPhotographs(),
      [](auto&, auto&) {
        return std::vector{Exposed(-0.8), Scaled(0.71), SmallAndExposed(0.71, 0.8)};
      },
      0.95);
}

}  // namespace
}  // namespace bladecurve
