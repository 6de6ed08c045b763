// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <numbers>
#include <vector>

namespace bladecurve {

// A pair of scissors, mm. Each blade in its own frame: origin at the pivot, +u to its distal end,
// +v to its back.
struct ScissorsSpec {
  double length_mm = 58;       // pivot to distal end; 25 (iris) to 70 (large Mayo)
  double heel_mm = 7;          // where the ground edge begins, from the pivot
  double inclination = 0.062;  // slope of the edge against the ray pivot -> distal end; 0.06 to 0.2
  double bow_mm = 0.3;   // the middle of the edge above its chord, alike on both blades; real edges
                         // are a bit hollow
  double skew_mm = 0;    // cubic part of that: more bow near the tip (+) or the heel (-)
  double curve_mm = 0;   // both blades bend to +y by this much: "curved" scissors
  double joint_mm = 12;  // how far the wide part reaches behind the pivot; the screw sits amid it
  double width_mm = 10;  // of a blade at the pivot
  double tip_radius_mm = 1.2;   // blunt Mayo 1.5, Metzenbaum 1, iris 0.3
  double bevel_mm = 1.6;        // ground band along the edge; 0: none
  double brushing = 1;          // strength of the streaks that grinding leaves; 0: smooth metal
  double thickness_mm = 1.9;    // of a blade
  double shank_mm = 5.0;        // width of a shank
  double shank_length_mm = 78;  // pivot to where the ring begins
  double ring_mm = 24;          // inner length of a ring
  double screw_radius_mm = 2.6;
  bool screw_visible = true;  // false: a pin ground flush, as in many joints
  double screw_mm = 1.9;      // how high its rim stands above the edge plane
  double slot_rad = 0.6;      // direction of the screw's slot
  // How far off the screw's centre the slot is cut, along and across it, of the screw's radius.
  Eigen::Vector2d slot_off = Eigen::Vector2d::Zero();
  bool upper_on_top = true;  // which blade lies over the other
};

enum class Finish { kSteel, kGold, kBlack };
enum class Backdrop { kPaper, kCloth, kDrape, kWood, kBlack, kLightTable, kCutOut };

// A DICT_4X4_50 marker lying on the sheet. World: mm on the sheet, y up as seen, origin at the
// image's centre.
struct MarkerSpec {
  int id = 0;           // 0 to 49
  double size_mm = 25;  // side of the black square
  Eigen::Vector2d center_mm = Eigen::Vector2d::Zero();
  double angle_rad = 0;  // counter-clockwise as seen
  double margin_mm = 5;  // white paper round it: its quiet zone
};

// A pinhole camera that looks at the world's origin.
struct CameraSpec {
  double mm_per_px = 0.15;      // on the sheet at the image's centre
  double distance_mm = 450;     // pinhole to world origin: an arm's length with a phone
  double tilt_rad = 0;          // of the optical axis from the sheet's normal
  double tilt_azimuth_rad = 0;  // direction on the sheet towards which the camera leans
  double k1 = 0;                // radial distortion, OpenCV's first coefficient
  double blur_px = 0.8;  // Gaussian sigma of lens and demosaicking; the pixel's box comes on top
};

struct LightSpec {
  double exposure = 0.78;        // linear value of white paper; below 1 so that it does not clip
  double falloff = 0.12;         // relative drop of the light across the picture
  double direction_rad = 2.2;    // where on the sheet the light comes from
  double elevation_rad = 1.0;    // above the sheet; the cast shadow is as long as height / tan
  double shadow = 0.35;          // share of the light that the cast shadow takes; 0: none
  double shadow_blur_mm = 1.5;   // width of its penumbra: 0.2 sun, 3 window
  double contact_shadow = 0.25;  // darkening of the sheet close to the metal
  double glint = 0.5;            // strength of highlights on the metal; above 1 they clip
};

struct SensorSpec {
  bool srgb = true;         // IEC 61966-2-1, else a pure power law
  double gamma = 2.2;       // of the power law
  double noise_grey = 1.5;  // standard deviation of the luma, grey levels; phones 1 to 4
};

// A photograph to be rendered; the defaults are an easy one.
struct SceneSpec {
  int width = 2000, height = 1500;
  bool with_scissors = true;  // false: an empty sheet, to be refused
  ScissorsSpec scissors;
  Finish finish = Finish::kSteel;
  double theta_rad = 25 * std::numbers::pi / 180;
  Eigen::Vector2d pivot_mm =
      Eigen::Vector2d(5, 0);  // in the world, of the pivot's foot on the sheet
  double heading_rad = 0.1;   // of the symmetry axis in the world, counter-clockwise as seen
  double edge_height_mm =
      2.0;  // plane of the cutting edges above the sheet: rings and shanks lift it
  CameraSpec camera;
  std::vector<MarkerSpec> markers;
  Backdrop backdrop = Backdrop::kPaper;
  Eigen::Vector3d drape_rgb = Eigen::Vector3d(0.10, 0.22, 0.42);  // linear colour of kDrape
  double texture = 1.0;  // strength of the backdrop's weave, folds or grain
  LightSpec light;
  SensorSpec sensor;
  std::uint64_t seed = 1;  // of texture and noise
};

// kSun: like kHard, in direct sun; the blades often black, pictures up to 12 megapixels.
enum class Difficulty { kClean, kStandard, kHard, kSun };

// The scene number `seed`: scissors, pose, camera, light and backdrop drawn from the range that the
// difficulty spans. All can be measured; see validate for scenes that must be refused. The same
// seed gives the same scene everywhere.
[[nodiscard]] SceneSpec RandomScene(std::uint64_t seed,
                                    Difficulty difficulty = Difficulty::kStandard);

}  // namespace bladecurve
