// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/scene/region_merging.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "vision/scene/pixel_neighbours.h"
#include "vision/scene/sharp_gradient.h"

namespace bladecurve {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

// The basins between walls: for each pixel the number, from 0, of the minimum that it runs down to.
class Basins {
 public:
  explicit Basins(const cv::Mat& walls) : bins_(WallBins(walls)), basin_of_(walls.total(), kDry) {
    std::array<std::vector<int>, kWallBins> pixels;
    const int count = static_cast<int>(walls.total());
    for (int p = 0; p < count; ++p) pixels[bins_.ptr()[p]].push_back(p);
    for (int bin = 0; bin < kWallBins; ++bin) {
      Spread(bin);
      for (const int p : pixels[Index(bin)]) {
        if (basin_of_[Index(p)] != kDry) continue;
        basin_of_[Index(p)] = count_++;
        shores_[Index(bin)].push_back(p);
        Spread(bin);
      }
    }
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int Of(int pixel) const { return basin_of_[Index(pixel)]; }

 private:
  static constexpr int kDry = -1;

  // Lets the water in the basins rise to a bin.
  void Spread(int bin) {
    std::vector<int>& shore = shores_[Index(bin)];  // grows meanwhile
    for (std::size_t k = 0; k < shore.size(); ++k) {
      const int p = shore[k];
      ForNeighbours(bins_.size(), p, [&](int q) {
        if (basin_of_[Index(q)] != kDry) return;
        basin_of_[Index(q)] = basin_of_[Index(p)];
        shores_[Index(std::max(bin, static_cast<int>(bins_.ptr()[q])))].push_back(q);
      });
    }
    shore.clear();
  }

  cv::Mat bins_;
  std::vector<int> basin_of_;
  std::array<std::vector<int>, kWallBins>
      shores_;  // pixels whose neighbours are still to be reached
  int count_ = 0;
};

// What two regions have in common: as many pairs of neighbouring pixels, and the sum of the higher
// wall of each pair.
struct Border {
  double sum = 0;
  int pairs = 0;

  [[nodiscard]] double Height() const { return sum / pairs; }
  void Add(const Border& other) {
    sum += other.sum;
    pairs += other.pairs;
  }
};

// Regions that are merged two by two, those with the lowest border on the average first.
class RegionMerging {
 public:
  explicit RegionMerging(int regions) : borders_(Index(regions)), joins_(Index(regions)) {
    for (int r = 0; r < regions; ++r) joins_[Index(r)] = {r, 0};
  }

  void AddBorder(int a, int b, const Border& border) {
    borders_[Index(a)][b].Add(border);
    borders_[Index(b)][a].Add(border);
  }

  void MergeAll() {
    for (int a = 0; a < static_cast<int>(borders_.size()); ++a) {
      for (const auto& [b, border] : borders_[Index(a)]) {
        if (a < b) Await(a, b, border);
      }
    }
    double height = 0;
    while (!waiting_.empty()) {
      const Meeting next = waiting_.top();
      waiting_.pop();
      if (!IsStill(next)) continue;
      height = std::max(height, next.height);
      auto [gone, kept] = std::pair(next.a, next.b);
      if (borders_[Index(gone)].size() > borders_[Index(kept)].size()) std::swap(gone, kept);
      Merge(gone, kept, height);
    }
  }

  // At what height each region has become one with `region`; 0 for those without a border.
  [[nodiscard]] std::vector<float> HeightsTo(int region) const {
    std::vector<double> on_way(joins_.size(), -1);  // from `region` up to the last
    double height = 0;
    for (int r = region;; r = joins_[Index(r)].into) {
      on_way[Index(r)] = height;
      if (joins_[Index(r)].into == r) break;
      height = joins_[Index(r)].height;
    }
    std::vector<float> heights;
    heights.reserve(joins_.size());
    for (int r = 0; r < static_cast<int>(joins_.size()); ++r) {
      double most = 0;
      int k = r;
      for (; on_way[Index(k)] < 0 && joins_[Index(k)].into != k; k = joins_[Index(k)].into)
        most = joins_[Index(k)].height;
      heights.push_back(static_cast<float>(std::max(most, on_way[Index(k)])));
    }
    return heights;
  }

 private:
  struct Join {
    int into = 0;  // itself for what was never merged into another
    double height = 0;
  };

  struct Meeting {
    double height = 0;
    int a = 0, b = 0, pairs = 0;
    bool operator<(const Meeting& other) const { return height > other.height; }
  };

  void Await(int a, int b, const Border& border) {
    waiting_.push({border.Height(), a, b, border.pairs});
  }

  // Both regions and the border between them are as they were.
  [[nodiscard]] bool IsStill(const Meeting& meeting) const {
    const auto& borders = borders_[Index(meeting.a)];
    const auto border = borders.find(meeting.b);
    return border != borders.end() && border->second.pairs == meeting.pairs;
  }

  void Merge(int gone, int kept, double height) {
    joins_[Index(gone)] = {kept, height};
    const std::unordered_map<int, Border> borders = std::move(borders_[Index(gone)]);
    borders_[Index(gone)].clear();
    borders_[Index(kept)].erase(gone);
    for (const auto& [other, border] : borders) {
      if (other == kept) continue;
      borders_[Index(other)].erase(gone);
      AddBorder(kept, other, border);
      Await(kept, other, borders_[Index(kept)][other]);
    }
  }

  std::vector<std::unordered_map<int, Border>> borders_;  // of each region to its neighbours
  std::vector<Join> joins_;
  std::priority_queue<Meeting> waiting_;
};

}  // namespace

cv::Mat MergingLevels(const cv::Mat& walls, const cv::Mat& ground) {
  const Basins basins(walls);
  const int background = basins.count();
  std::vector<int> region_of(Index(basins.count()));
  std::iota(region_of.begin(), region_of.end(), 0);
  const int pixels = static_cast<int>(walls.total());
  for (int p = 0; p < pixels; ++p) {
    if (ground.ptr()[p] != 0) region_of[Index(basins.Of(p))] = background;
  }

  RegionMerging regions(basins.count() + 1);
  const float* height = walls.ptr<float>();
  for (int p = 0; p < pixels; ++p) {
    const int a = region_of[Index(basins.Of(p))];
    ForLaterNeighbours(walls.size(), p, [&](int q) {
      const int b = region_of[Index(basins.Of(q))];
      if (a != b) regions.AddBorder(a, b, {std::max(height[p], height[q]), 1});
    });
  }
  regions.MergeAll();

  const std::vector<float> heights = regions.HeightsTo(background);
  cv::Mat levels(walls.size(), CV_32FC1);
  for (int p = 0; p < pixels; ++p)
    levels.ptr<float>()[p] = heights[Index(region_of[Index(basins.Of(p))])];
  return levels;
}

}  // namespace bladecurve
