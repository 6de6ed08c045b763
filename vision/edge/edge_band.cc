// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/edge/edge_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/image/bilinear.h"

namespace bladecurve {
namespace {

using Eigen::Vector2d;

// Samples [first, last] along which the path keeps nearer to one axis of the picture: within it,
// scanning lines across that axis meet the path once.
struct Run {
  int first = 0, last = 0;
  bool along_x = true;
};

bool NearerToX(const Vector2d& tangent) { return std::abs(tangent.x()) >= std::abs(tangent.y()); }

std::vector<Run> SplitIntoRuns(const EdgePath& path) {
  std::vector<Run> runs;
  for (int i = 0; i < path.size(); ++i) {
    const bool along_x = NearerToX(path.tangents[Index(i)]);
    if (runs.empty() || runs.back().along_x != along_x) runs.push_back({i, i, along_x});
    runs.back().last = i;
  }
  return runs;
}

// Where a pixel lies against the path: its nearest sample and its distance from the curve.
struct Foot {
  int sample = 0;
  double along = 0, across = 0;
};

Foot FindFoot(const EdgePath& path, const Vector2d& pixel, int start) {
  constexpr int kSteps =
      4;  // each lands within a sample or two of the foot where the path turns gently
  Foot foot;
  foot.sample = start;
  for (int step = 0; step < kSteps; ++step) {
    const Vector2d offset = pixel - path.points[Index(foot.sample)];
    foot.along = offset.dot(path.tangents[Index(foot.sample)]);
    foot.across = offset.dot(path.normals[Index(foot.sample)]);
    // Where the path bends towards the pixel its samples lie closer together as the pixel sees
    // them.
    const double seen = 1 + path.curvatures[Index(foot.sample)] * foot.across;
    const int next =
        std::clamp(foot.sample + cvRound(foot.along / std::max(seen, 0.2)), 0, path.size() - 1);
    if (next == foot.sample) break;
    foot.sample = next;
  }
  // Convex blade: the curve falls away from its tangent towards the blade.
  foot.across += 0.5 * path.curvatures[Index(foot.sample)] * foot.along * foot.along;
  return foot;
}

struct PlacedPixel {
  int sample = 0;
  BandPixel pixel;
};

// Scans a run line by line; a pixel belongs to the run that holds its foot.
class RunScanner {
 public:
  RunScanner(const cv::Mat& grey,
             const ToneCurve& tone,
             const EdgePath& path,
             const BandReach& reach)
      : grey_(grey),
        tone_(tone),
        path_(path),
        reach_(reach),
        inner_px_(*std::max_element(reach.inner_px.begin(), reach.inner_px.end())),
        outer_px_(*std::max_element(reach.outer_px.begin(), reach.outer_px.end())) {}

  void Scan(const Run& run, std::vector<PlacedPixel>& found) const {
    const int axis = run.along_x ? 0 : 1;
    const double reach = std::max(inner_px_, outer_px_) + 1;
    const double a = path_.points[Index(run.first)][axis], b = path_.points[Index(run.last)][axis];
    const int limit = (run.along_x ? grey_.cols : grey_.rows) - 1;
    const int low = std::max(0, cvCeil(std::min(a, b) - reach));
    const int high = std::min(limit, cvFloor(std::max(a, b) + reach));
    const bool forward = b >= a;
    int sample = forward ? run.first : run.last;
    const int toward = forward ? 1 : -1, end = forward ? run.last : run.first;
    for (int line = low; line <= high; ++line) {
      while (sample != end && path_.points[Index(sample)][axis] < line) sample += toward;
      ScanLine(run, line, sample, found);
    }
  }

 private:
  void ScanLine(const Run& run, int line, int sample, std::vector<PlacedPixel>& found) const {
    const int axis = run.along_x ? 0 : 1, other = 1 - axis;
    const Vector2d& point = path_.points[Index(sample)];
    const Vector2d& tangent = path_.tangents[Index(sample)];
    const Vector2d& normal = path_.normals[Index(sample)];
    const double center = point[other] + (line - point[axis]) * tangent[other] / tangent[axis];
    const double out = outer_px_ / normal[other], in = -inner_px_ / normal[other];
    const int limit = (run.along_x ? grey_.rows : grey_.cols) - 1;
    const int low = std::max(0, cvCeil(center + std::min(out, in) - 1));
    const int high = std::min(limit, cvFloor(center + std::max(out, in) + 1));
    for (int cross = low; cross <= high; ++cross) {
      const int x = run.along_x ? line : cross, y = run.along_x ? cross : line;
      const Foot foot = FindFoot(path_, Vector2d(x, y), sample);
      if (foot.sample < run.first || foot.sample > run.last) continue;
      if (foot.across < -reach_.inner_px[Index(foot.sample)]) continue;
      if (foot.across > reach_.outer_px[Index(foot.sample)]) continue;
      constexpr double kBeyondEnd = 0.75;  // px past the last sample: not beside the path any more
      if (std::abs(foot.along) > kBeyondEnd &&
          (foot.sample == 0 || foot.sample == path_.size() - 1))
        continue;
      found.push_back(
          {foot.sample, {static_cast<float>(foot.across), tone_.linear[grey_.at<uchar>(y, x)]}});
    }
  }

  const cv::Mat& grey_;
  const ToneCurve& tone_;
  const EdgePath& path_;
  const BandReach& reach_;
  double inner_px_, outer_px_;
};

// Between the four pixels about a place within the picture.
float BilinearLight(const cv::Mat& grey, const ToneCurve& tone, const Vector2d& at) {
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  const auto u = static_cast<float>(at.x() - x), v = static_cast<float>(at.y() - y);
  const uchar* upper = grey.ptr<uchar>(y) + x;
  const uchar* lower = upper + grey.step1();
  const float top = tone.linear[upper[0]] * (1 - u) + tone.linear[upper[1]] * u;
  const float bottom = tone.linear[lower[0]] * (1 - u) + tone.linear[lower[1]] * u;
  return top * (1 - v) + bottom * v;
}

}  // namespace

PixelBand GatherPixels(const cv::Mat& grey,
                       const ToneCurve& tone,
                       const EdgePath& path,
                       const BandReach& reach) {
  std::vector<PlacedPixel> found;
  constexpr size_t kUsualReach = 12;
  found.reserve(Index(path.size()) * kUsualReach);
  const RunScanner scanner(grey, tone, path, reach);
  for (const Run& run : SplitIntoRuns(path)) scanner.Scan(run, found);

  PixelBand band;
  band.begin.assign(Index(path.size()) + 1, 0);
  for (const PlacedPixel& placed : found) ++band.begin[Index(placed.sample) + 1];
  for (size_t i = 1; i < band.begin.size(); ++i) band.begin[i] += band.begin[i - 1];
  band.pixels.resize(found.size());
  std::vector<int> next(band.begin.begin(), band.begin.end() - 1);
  for (const PlacedPixel& placed : found)
    band.pixels[Index(next[Index(placed.sample)]++)] = placed.pixel;
  return band;
}

StraightBand StraightenBand(const cv::Mat& grey,
                            const ToneCurve& tone,
                            const EdgePath& path,
                            double inner_px,
                            double outer_px) {
  StraightBand band;
  band.columns = path.size();
  band.rows = static_cast<int>(std::lround(inner_px + outer_px)) + 1;
  band.first_across_px = -inner_px;
  band.light.resize(Index(band.columns) * Index(band.rows));
  float* light = band.light.data();
  for (int column = 0; column < band.columns; ++column) {
    const Vector2d& normal = path.normals[Index(column)];
    Vector2d at = path.points[Index(column)] + band.first_across_px * normal;
    const bool within = LiesWithin(grey, at - normal) &&
                        LiesWithin(grey, at + static_cast<double>(band.rows) * normal);
    for (int row = 0; row < band.rows; ++row, at += normal) {
      *light++ = within || LiesWithin(grey, at) ? BilinearLight(grey, tone, at)
                                                : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return band;
}

}  // namespace bladecurve
