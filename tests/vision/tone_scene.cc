// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "vision/tone_scene.h"

#include <filesystem>

#include "process_folder.h"
#include "vision/card_scene.h"
#include "vision/edge/edge.h"
#include "vision/photo/png_writer.h"
#include "vision/scale/card.h"
#include "vision/scale/scale.h"

namespace bladecurve::testing {

using Eigen::Vector2d;

ToneCurve ToneByCard(const SensorSpec& sensor) {
  SceneSpec scene = OnCard(BuiltInCard(Paper::kA4), 0);
  scene.sensor = sensor;
  const std::filesystem::path picture = ProcessFolder() / "tone.png";
  WritePng(picture, RenderScene(scene).bgr);
  return FindScale(Photo::Load(picture), {}).tone;
}

double OffsetOfEdge(const EdgeLook& look, const ToneCurve& tone) {
  constexpr int kSide = 300, kHalfLength = 100;
  const Vector2d normal = Direction(0.4), along(-normal.y(), normal.x());
  const Vector2d middle = Vector2d::Constant(kSide / 2);
  Gaussian random(3);
  const cv::Mat grey = Photographed(
      HalfPlaneCoverage({kSide, kSide}, normal, normal.dot(middle), look.blur_px), look, random);
  EdgeGuess guess;
  guess.path_px = {middle - kHalfLength * along, middle + kHalfLength * along};
  guess.blade_on_left = false;
  double sum = 0, count = 0;
  for (const LocatedEdgePoint& point : LocateEdge(grey, tone, guess).points) {
    sum += normal.dot(point.point_px - middle);
    ++count;
  }
  return sum / count;
}

}  // namespace bladecurve::testing
