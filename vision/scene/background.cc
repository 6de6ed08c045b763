// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/background.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/image/robust_statistics.h"
#include "vision/parallel.h"

namespace bladecurve {
namespace {

constexpr int kTerms = BackgroundModel::kTerms;
using Terms = Eigen::Matrix<double, kTerms, 1>;
using TermsOfAll = Eigen::Matrix<double, Eigen::Dynamic, kTerms>;
using NormalMatrix = Eigen::Matrix<double, kTerms, kTerms>;  // only its lower half is used

constexpr int kSamples = 6000;     // enough for 10 terms; more costs time and changes nothing
constexpr int kIterations = 15;    // reweighting has settled before, but for huge foregrounds
constexpr double kSettled = 0.02;  // of the scatter: no threshold tells such a change
constexpr double kScatterFloor =
    0.5;  // grey or Lab units: rounding and JPEG noise of a clean catalogue picture

Terms TermsAt(double x, double y) {
  Terms t;
  t << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return t;
}

struct Samples {
  TermsOfAll terms;
  Eigen::MatrixXd values;  // one column a channel
};

Samples TakeSamples(const cv::Mat& image, const cv::Mat& ignore) {
  const int channels = image.channels();
  // A stride that shares no factor with usual widths walks over all columns.
  int stride = std::max(1, static_cast<int>(image.total() / kSamples)) | 1;
  while (image.cols % stride == 0 && stride > 1) stride += 2;
  Samples samples;
  const int most = static_cast<int>(image.total()) / stride + 1;
  samples.terms.resize(most, kTerms);
  samples.values.resize(most, channels);
  int count = 0;
  for (int i = 0; i < static_cast<int>(image.total()); i += stride) {
    const int row = i / image.cols;
    const int col = i % image.cols;
    if (!ignore.empty() && ignore.at<uchar>(row, col) != 0) continue;
    samples.terms.row(count) =
        TermsAt((2.0 * col + 1) / image.cols - 1, (2.0 * row + 1) / image.rows - 1).transpose();
    const float* pixel = image.ptr<float>(row) + static_cast<std::ptrdiff_t>(col) * channels;
    for (int c = 0; c < channels; ++c) samples.values(count, c) = pixel[c];
    ++count;
  }
  samples.terms.conservativeResize(count, Eigen::NoChange);
  samples.values.conservativeResize(count, Eigen::NoChange);
  return samples;
}

// Standard deviation by the median absolute residual, over the samples that still count as
// background.
double RobustScatter(const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights) {
  constexpr double kStillBackground = 0.05;
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(residuals.size()));
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    if (weights[i] > kStillBackground) sizes.push_back(std::abs(residuals[i]));
  }
  if (sizes.empty()) return kScatterFloor;
  return kSigmaPerMedian * Median(std::move(sizes)) + kScatterFloor;
}

// What BackgroundModel holds, as its fit wants it.
struct Surface {
  Eigen::MatrixXd coefficients;  // kTerms x channels
  Eigen::VectorXd scatter;       // one a channel
};

Eigen::MatrixXd Residuals(const Surface& surface, const Samples& samples) {
  return samples.values - samples.terms * surface.coefficients;
}

// Squared Cauchy weights: scissors that cover a third of the picture have no say.
Eigen::VectorXd Weights(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& scatter) {
  const Eigen::VectorXd squared =
      (residuals * scatter.cwiseInverse().asDiagonal()).rowwise().squaredNorm();
  return (1 + squared.array() / 4).inverse().square().matrix();
}

// One round; leaves the weights for the next.
Surface Reweight(const Samples& samples, Eigen::VectorXd* weights) {
  const TermsOfAll weighted = weights->asDiagonal() * samples.terms;
  NormalMatrix normal = 1e-9 * NormalMatrix::Identity();
  for (int i = 0; i < kTerms; ++i) {
    for (int j = 0; j <= i; ++j) normal(i, j) += weighted.col(i).dot(samples.terms.col(j));
  }
  Surface surface{normal.ldlt().solve(weighted.transpose() * samples.values), {}};
  const Eigen::MatrixXd residuals = Residuals(surface, samples);
  surface.scatter.resize(residuals.cols());
  for (Eigen::Index c = 0; c < residuals.cols(); ++c)
    surface.scatter[c] = RobustScatter(residuals.col(c), *weights);
  *weights = Weights(residuals, surface.scatter);
  return surface;
}

// Reweights until nothing changes any more.
Surface Settle(const Samples& samples, Eigen::VectorXd weights) {
  Surface surface = Reweight(samples, &weights);
  for (int i = 1; i < kIterations; ++i) {
    const Surface before = std::exchange(surface, Reweight(samples, &weights));
    // No term exceeds 1 in the picture, so the background has not moved by more anywhere.
    const Eigen::RowVectorXd moved =
        (surface.coefficients - before.coefficients).cwiseAbs().colwise().sum();
    if (moved.transpose().cwiseQuotient(surface.scatter).maxCoeff() <= kSettled) break;
  }
  return surface;
}

// A tenth of the samples lead nearly there, at a tenth of the cost.
Surface SettleFromFew(const Samples& all) {
  constexpr Eigen::Index kStep = 10;
  constexpr Eigen::Index kLeast = 300;  // fewer lead astray
  const Eigen::Index count = all.terms.rows() / kStep;
  if (count < kLeast) return Settle(all, Eigen::VectorXd::Ones(all.terms.rows()));
  const auto few = Eigen::seqN(0, count, kStep);
  const Surface rough = Settle({all.terms(few, Eigen::all), all.values(few, Eigen::all)},
                               Eigen::VectorXd::Ones(count));
  return Settle(all, Weights(Residuals(rough, all), rough.scatter));
}

// The background's value along one row, a cubic in x, for one channel.
class RowOfBackground {
 public:
  RowOfBackground(const std::array<double, kTerms>& k, const cv::Size& size, int row) {
    const double y = 2 * (row + 0.5) / size.height - 1;
    c0_ = static_cast<float>(k[0] + y * (k[2] + y * (k[5] + y * k[9])));
    c1_ = static_cast<float>(k[1] + y * (k[4] + y * k[8]));
    c2_ = static_cast<float>(k[3] + y * k[7]);
    c3_ = static_cast<float>(k[6]);
    x0_ = static_cast<float>(1.0 / size.width - 1);
    dx_ = static_cast<float>(2.0 / size.width);
  }
  float operator()(int col) const {
    const float x = x0_ + dx_ * static_cast<float>(col);
    return c0_ + x * (c1_ + x * (c2_ + x * c3_));
  }

 private:
  float c0_, c1_, c2_, c3_, x0_, dx_;
};

// fill(row) for every row, on several threads.
template <typename Fill>
void ForEachRow(int rows, const Fill& fill) {
  ParallelForBands(rows, [&](int first, int last) {
    for (int row = first; row < last; ++row) fill(row);
  });
}

// The number of channels is known to the compiler: it takes many pixels at a time.
template <int kChannels>
cv::Mat DistanceIn(const cv::Mat& image, const BackgroundModel& background) {
  cv::Mat distance(image.size(), CV_32FC1);
  const auto fill_row = [&](int row) {
    const float* pixels = image.ptr<float>(row);
    float* out = distance.ptr<float>(row);
    std::fill(out, out + image.cols, 0.0f);
    for (int c = 0; c < kChannels; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      const RowOfBackground expected(background.coefficients[channel], image.size(), row);
      const auto inverse = static_cast<float>(1 / background.scatter[channel]);
      for (int col = 0; col < image.cols; ++col) {
        const float off = (pixels[col * kChannels + c] - expected(col)) * inverse;
        out[col] += off * off;
      }
    }
  };
  ParallelForBands(image.rows, [&](int first, int last) {
    for (int row = first; row < last; ++row) fill_row(row);
    cv::Mat band = distance.rowRange(first, last);
    cv::sqrt(band, band);
  });
  return distance;
}

}  // namespace

BackgroundModel FitBackground(const cv::Mat& image, const cv::Mat& ignore) {
  const int channels = image.channels();
  const Samples samples = TakeSamples(image, ignore);
  Surface surface{Eigen::MatrixXd::Zero(kTerms, channels),
                  Eigen::VectorXd::Constant(channels, kScatterFloor)};
  if (samples.terms.rows() >= kTerms) surface = SettleFromFew(samples);
  BackgroundModel model;
  for (int c = 0; c < channels; ++c) {
    std::array<double, kTerms> row{};
    for (int t = 0; t < kTerms; ++t) row[static_cast<std::size_t>(t)] = surface.coefficients(t, c);
    model.coefficients.push_back(row);
    model.scatter.push_back(surface.scatter[c]);
  }
  return model;
}

cv::Mat AboveBackground(const cv::Mat& image, const BackgroundModel& background) {
  cv::Mat above(image.size(), CV_32FC1);
  const auto fill_row = [&](int row) {
    const RowOfBackground expected(background.coefficients[0], image.size(), row);
    const float* pixels = image.ptr<float>(row);
    float* out = above.ptr<float>(row);
    for (int col = 0; col < image.cols; ++col) out[col] = pixels[col] - expected(col);
  };
  ForEachRow(image.rows, fill_row);
  return above;
}

cv::Mat DistanceFromBackground(const cv::Mat& image, const BackgroundModel& background) {
  return image.channels() == 1 ? DistanceIn<1>(image, background)
                               : DistanceIn<3>(image, background);
}

cv::Mat DistanceFromShadedBackground(const cv::Mat& bgr, const BackgroundModel& background) {
  constexpr float kDeepestShadow = 0.15f;  // darker than that is no shadow but something black
  cv::Mat distance(bgr.size(), CV_32FC1);
  std::array<float, 3> inverse{};
  for (std::size_t c = 0; c < 3; ++c) inverse[c] = static_cast<float>(1 / background.scatter[c]);
  const auto fill_row = [&](int row) {
    const RowOfBackground rows[3] = {{background.coefficients[0], bgr.size(), row},
                                     {background.coefficients[1], bgr.size(), row},
                                     {background.coefficients[2], bgr.size(), row}};
    const cv::Vec3f* pixels = bgr.ptr<cv::Vec3f>(row);
    float* out = distance.ptr<float>(row);
    for (int col = 0; col < bgr.cols; ++col) {
      const cv::Vec3f light(rows[0](col), rows[1](col), rows[2](col));
      const float best = pixels[col].dot(light) / std::max(1e-3f, light.dot(light));
      const float shade = std::clamp(best, kDeepestShadow, 1.0f);
      float squared = 0;
      for (int c = 0; c < 3; ++c) {
        const float off =
            (pixels[col][c] - shade * light[c]) * inverse[static_cast<std::size_t>(c)];
        squared += off * off;
      }
      out[col] = std::sqrt(squared);
    }
  };
  ForEachRow(bgr.rows, fill_row);
  return distance;
}

}  // namespace bladecurve
