// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "model/blade_file.h"
#include "samples/json_arrays.h"
#include "tests/degree.h"
#include "tests/samples/picture_files.h"
#include "tests/samples/program_run.h"
#include "vision/photo/photo.h"
#include "vision/render/render.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Eigen::Vector2d;

// Seen straight from above, so that one number is the scale of the whole picture.
SceneSpec SceneFromAbove() {
  SceneSpec scene;
  scene.width = 1200;
  scene.height = 900;
  scene.camera.mm_per_px = 0.2;
  return scene;
}

const RenderedPhoto& PhotoFromAbove() {
  static const RenderedPhoto photo = RenderScene(SceneFromAbove());
  return photo;
}

std::string MmPerPx() { return std::to_string(PhotoFromAbove().truth.mm_per_px); }

Json MustFit(const fs::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "fit");
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProgramRun run = RunBladecurve(arguments, folder);
  EXPECT_EQ(run.exit_code, 0) << run.standard_error << run.standard_output.substr(0, 300);
  Json record = Json::parse(run.standard_output, nullptr, false);
  EXPECT_TRUE(record.is_object());
  return record;
}

Json MustFitFile(const fs::path& folder, const std::string& name, const std::string& bytes) {
  WriteText(folder / name, bytes);
  return MustFit(folder, {name, "--mm-per-px", MmPerPx()});
}

// The same scissors in another file: other rounding and compression are other noise, so the poses
// differ by no more than three of their joint stated uncertainties.
void ExpectSameMeasurement(const Json& a, const Json& b) {
  constexpr double kSigmas = 3;
  ASSERT_TRUE(a.contains("photos") && b.contains("photos"));
  const Json &photo_a = a["photos"][0], &photo_b = b["photos"][0];
  EXPECT_EQ(photo_a["width"], photo_b["width"]);
  EXPECT_EQ(photo_a["height"], photo_b["height"]);
  const auto joint = [&](const char* sigma) {
    return std::hypot(photo_a[sigma].get<double>(), photo_b[sigma].get<double>());
  };
  EXPECT_LT((PointOf(photo_a["pivot_px"]) - PointOf(photo_b["pivot_px"])).norm(),
            kSigmas * joint("pivot_sigma_px"));
  EXPECT_NEAR(photo_a["theta_rad"].get<double>(),
              photo_b["theta_rad"].get<double>(),
              kSigmas * joint("theta_sigma_rad"));
}

TEST(Fit, WritesTheCurveAndItsPicture) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const ProgramRun run =
      RunBladecurve({"fit", "scissors.jpg", "--mm-per-px", MmPerPx(), "--quiet"}, folder);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.standard_output + run.standard_error, "");
  EXPECT_EQ(ReadText(folder / "scissors.overlay.png").substr(1, 3), "PNG");
  const BladeFile blade = ReadBladeFile(folder / "scissors.blade.json");
  EXPECT_EQ(blade.name, "scissors");
}

TEST(Fit, JsonToStandardOutputWritesNoFile) {
  const fs::path folder = TestFolder();
  MustFitFile(folder, "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  EXPECT_FALSE(fs::exists(folder / "scissors.blade.json"));
  EXPECT_FALSE(fs::exists(folder / "scissors.overlay.png"));
}

TEST(Fit, ResultHasTheKeysOfTheFormat) {
  const Json record = MustFitFile(TestFolder(), "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  for (const char* key : {"format",
                          "name",
                          "status",
                          "warnings",
                          "software",
                          "curve",
                          "alternatives",
                          "domain",
                          "covariance",
                          "fit",
                          "photos"}) {
    EXPECT_TRUE(record.contains(key)) << key;
  }
  const Json photo = record.at("photos").at(0);
  for (const char* key : {"file",
                          "sha256",
                          "width",
                          "height",
                          "pivot_px",
                          "pivot_sigma_px",
                          "axis_px",
                          "theta_rad",
                          "theta_sigma_rad",
                          "theta_source",
                          "mm_per_px",
                          "mm_per_px_sigma",
                          "scale_source",
                          "upper_edge_px",
                          "upper_edge_mm",
                          "upper_edge_sigma_px",
                          "lower_edge_px",
                          "upper_end_px",
                          "lower_end_px",
                          "plan",
                          "ms_total"}) {
    EXPECT_TRUE(photo.contains(key)) << key;
  }
  EXPECT_EQ(record["format"], "bladecurve/1");
  EXPECT_EQ(record["status"] == "review", !record["warnings"].empty());
  EXPECT_EQ(record["covariance"]["matrix"].size(), record["covariance"]["parameters"].size());
}

// phi at theta_rad, drawn in the frame of pivot_px, axis_px and mm_per_px, is the edge that was
// located.
TEST(Fit, CurveLiesOnTheLocatedEdge) {
  const fs::path folder = TestFolder();
  const Json record = MustFitFile(folder, "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  WriteText(folder / "r.blade.json", record.dump());
  const BladeCurve curve = ReadBladeFile(folder / "r.blade.json").curve;
  const Json& photo = record["photos"][0];
  const Vector2d pivot = PointOf(photo["pivot_px"]), axis = PointOf(photo["axis_px"]);
  const Vector2d upwards(axis.y(), -axis.x());
  const double mm_per_px = photo["mm_per_px"], theta_rad = photo["theta_rad"];
  double sum = 0;
  for (const Json& point : photo["upper_edge_px"]) {
    const Vector2d from_pivot = PointOf(point) - pivot;
    const double x_mm = mm_per_px * axis.dot(from_pivot),
                 y_mm = mm_per_px * upwards.dot(from_pivot);
    sum += std::pow((curve.Eval(x_mm, theta_rad).phi_mm - y_mm) / mm_per_px, 2);
  }
  const double rms_px = std::sqrt(sum / static_cast<double>(photo["upper_edge_px"].size()));
  // Robust fits leave some points out of their own rms; another factor would be another edge.
  EXPECT_LT(rms_px, 2 * record["fit"]["rms_px"].get<double>() + 0.05);
}

TEST(Fit, FindsTheTruthOfARenderedPhotograph) {
  const SceneTruth& truth = PhotoFromAbove().truth;
  const Json record = MustFitFile(TestFolder(), "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const Json& photo = record["photos"][0];
  const double pivot_sigma_px = photo["pivot_sigma_px"], theta_sigma_rad = photo["theta_sigma_rad"];
  // Four sigma: one scene in ten thousand may be further off.
  EXPECT_LT((PointOf(photo["pivot_px"]) - truth.pivot_px).norm(), 4 * pivot_sigma_px + 0.1);
  EXPECT_NEAR(photo["theta_rad"].get<double>(), truth.theta_rad, 4 * theta_sigma_rad + 1e-3);
}

TEST(Fit, GivenThetaIsAsGoodAsAProtractorAndIsDoubtedWhereTheEndsSayOtherwise) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const double truth_deg = PhotoFromAbove().truth.theta_rad / kDegree;
  const auto given = [&](double theta_deg) {
    const std::string theta = std::to_string(theta_deg);
    return MustFit(folder, {"scissors.jpg", "--mm-per-px", MmPerPx(), "--theta-deg", theta});
  };
  const Json near = given(truth_deg + 0.3);
  const Json& photo = near["photos"][0];
  EXPECT_EQ(photo["theta_source"], "given");
  EXPECT_NEAR(photo["theta_rad"].get<double>(), (truth_deg + 0.3) * kDegree, 1e-6);
  EXPECT_NEAR(photo["theta_sigma_rad"].get<double>(), 0.5 * kDegree, 0.05 * kDegree);
  const auto is_doubted = [](const Json& record) {
    const Json& warnings = record["warnings"];
    return std::find(warnings.begin(), warnings.end(), "theta_given_differs") != warnings.end();
  };
  EXPECT_FALSE(is_doubted(near));
  const Json far = given(truth_deg + 15);
  EXPECT_TRUE(is_doubted(far));
  EXPECT_EQ(far["status"], "review");
}

TEST(Fit, OnePictureGivenTwiceIsWrongUse) {
  const fs::path folder = TestFolder();
  const std::string jpeg = JpegFile(PhotoFromAbove().bgr);
  WriteText(folder / "a.jpg", jpeg);
  WriteText(folder / "b.jpg", jpeg);
  const ProgramRun run = RunBladecurve({"fit", "a.jpg", "b.jpg", "--mm-per-px", "0.2"}, folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.standard_error.find("a.jpg and b.jpg are the same picture"), std::string::npos);
}

TEST(Fit, NoOutputReplacesAPhotograph) {
  const fs::path folder = TestFolder();
  const std::string png = PngFile(PhotoFromAbove().bgr, PngKind::kRgb8);
  WriteText(folder / "a.png", png);
  const ProgramRun run =
      RunBladecurve({"fit", "a.png", "--mm-per-px", "0.2", "--overlay", "a.png"}, folder);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(ReadText(folder / "a.png"), png);
}

TEST(Fit, HintsOutsideThePictureAreWrongUse) {
  const fs::path folder = TestFolder();
  WriteText(folder / "a.jpg", JpegFile(PhotoFromAbove().bgr));
  for (const auto& [flag, value] : std::vector<std::pair<std::string, std::string>>{
           {"--pivot", "5000,10"}, {"--pivot", "-5,10"}, {"--roi", "3000,0,100,100"}}) {
    const ProgramRun run =
        RunBladecurve({"fit", "a.jpg", "--mm-per-px", "0.2", flag + "=" + value}, folder);
    EXPECT_EQ(run.exit_code, 2) << flag;
    EXPECT_NE(run.standard_error.find("outside the picture"), std::string::npos) << flag;
  }
  const ProgramRun apart = RunBladecurve(
      {"fit", "a.jpg", "--mm-per-px", "0.2", "--pivot", "300,200", "--roi", "0,0,200,300"}, folder);
  EXPECT_EQ(apart.exit_code, 2);
  EXPECT_NE(apart.standard_error.find("outside the region"), std::string::npos);
}

TEST(Fit, PixelsCutNothing) {
  const fs::path folder = TestFolder();
  WriteText(folder / "a.jpg", JpegFile(PhotoFromAbove().bgr));
  const ProgramRun fit = RunBladecurve({"fit", "a.jpg", "--units", "px"}, folder);
  EXPECT_EQ(fit.exit_code, 0) << fit.standard_error;
  EXPECT_EQ(Json::parse(ReadText(folder / "a.blade.json"))["units"], "px");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"torque", "a.blade.json", "--material", "paper", "--close-deg", "30:1"},
           {"export", "a.blade.json", "--as", "c"}}) {
    const ProgramRun run = RunBladecurve(arguments, folder);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.standard_error.find("is in pixels"), std::string::npos) << run.standard_error;
  }
}

TEST(Fit, EveryOrientationGivesTheDisplayedPicture) {
  const fs::path folder = TestFolder();
  const Json upright = MustFitFile(folder, "1.jpg", JpegFile(PhotoFromAbove().bgr));
  for (int orientation = 2; orientation <= 8; ++orientation) {
    SCOPED_TRACE("EXIF orientation " + std::to_string(orientation));
    const std::string jpeg = JpegFile(StoredFor(PhotoFromAbove().bgr, orientation));
    const Json turned = MustFitFile(
        folder, std::to_string(orientation) + ".jpg", WithOrientation(jpeg, orientation));
    ExpectSameMeasurement(upright, turned);
  }
}

// A marker in a mirror is no marker: such files are mirrored back before anything is read in them.
TEST(Fit, MarkersOfMirroredFilesAreRead) {
  const fs::path folder = TestFolder();
  const auto fit = [&](const std::string& file) {
    return MustFit(folder, {file, "--marker-mm", "25"});
  };
  const Json upright = fit((SamplePhotos() / "mayo.jpg").string());
  const Photo photo = Photo::Load(SamplePhotos() / "mayo.jpg");
  const cv::Mat shown = photo.DecodeColour(std::max(photo.grey().cols, photo.grey().rows));
  for (const int orientation : {2, 4, 5, 7}) {
    SCOPED_TRACE("EXIF orientation " + std::to_string(orientation));
    const std::string jpeg = JpegFile(StoredFor(shown, orientation));
    WriteText(folder / "mirrored.jpg", WithOrientation(jpeg, orientation));
    const Json mirrored = fit("mirrored.jpg");
    ExpectSameMeasurement(upright, mirrored);
    EXPECT_NEAR(mirrored["photos"][0]["mm_per_px"].get<double>() /
                    upright["photos"][0]["mm_per_px"].get<double>(),
                1,
                1e-3);
  }
}

TEST(Fit, EveryPixelFormatGivesTheSameScissors) {
  const fs::path folder = TestFolder();
  const cv::Mat& picture = PhotoFromAbove().bgr;
  const Json reference = MustFitFile(folder, "rgb.png", PngFile(picture, PngKind::kRgb8));
  for (const PngKind kind : {PngKind::kGrey8,
                             PngKind::kGrey16,
                             PngKind::kRgb16,
                             PngKind::kRgba8,
                             PngKind::kGreyAlpha8}) {
    SCOPED_TRACE("PngKind " + std::to_string(static_cast<int>(kind)));
    ExpectSameMeasurement(reference, MustFitFile(folder, "other.png", PngFile(picture, kind)));
  }
}

TEST(Fit, PaletteAndCmykGiveTheSameScissors) {
  const fs::path folder = TestFolder();
  const cv::Mat& picture = PhotoFromAbove().bgr;
  const Json reference = MustFitFile(folder, "rgb.png", PngFile(picture, PngKind::kRgb8));
  // So few colours may swallow the screw's rim; then the uncertainties have to say so.
  const Json palette = MustFitFile(folder, "palette.png", PngFile(picture, PngKind::kPalette));
  ExpectSameMeasurement(reference, palette);
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  cv::Mat inks;  // C = 1 - R and so on, no black ink
  const std::vector<cv::Mat> cmyk = {
      ~channels[2], ~channels[1], ~channels[0], cv::Mat::zeros(picture.size(), CV_8U)};
  cv::merge(cmyk, inks);
  ExpectSameMeasurement(reference, MustFitFile(folder, "inks.jpg", JpegFile(inks)));
}

TEST(Fit, SameInputGivesTheSameBytesWhateverTheThreads) {
  const fs::path folder = TestFolder();
  const std::vector<std::string> arguments = {"fit",
                                              (SamplePhotos() / "mayo.jpg").string(),
                                              (SamplePhotos() / "mayo_wide.jpg").string(),
                                              "--marker-mm",
                                              "25",
                                              "--json",
                                              "-",
                                              "--no-times",
                                              "--threads"};
  std::vector<std::string> results;
  for (const char* threads : {"1", "2", "4", "1"}) {  // 4: two for the parts of each photograph
    std::vector<std::string> with_threads = arguments;
    with_threads.emplace_back(threads);
    results.push_back(RunBladecurve(with_threads, folder).standard_output);
  }
  EXPECT_NE(results[0].find("\"curve\""), std::string::npos) << results[0];
  EXPECT_TRUE(results[0] == results[1]) << "two threads give other bytes";
  EXPECT_TRUE(results[0] == results[2]) << "four threads give other bytes";
  EXPECT_TRUE(results[0] == results[3]) << "a second run gives other bytes";
}

TEST(Fit, TimesAreLeftOutOnRequest) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const Json record = MustFit(folder, {"scissors.jpg", "--mm-per-px", MmPerPx(), "--no-times"});
  EXPECT_FALSE(record["photos"][0].contains("ms_total"));
  EXPECT_FALSE(record["photos"][0]["plan"][0].contains("ms"));
}

TEST(Fit, PlanFullRunsEveryStage) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const auto skipped = [&](const std::vector<std::string>& flags) {
    std::vector<std::string> arguments = {"scissors.jpg", "--mm-per-px", MmPerPx()};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Json record = MustFit(folder, arguments);
    return std::ranges::count_if(record["photos"][0]["plan"],
                                 [](const Json& stage) { return !stage["ran"].get<bool>(); });
  };
  EXPECT_GT(skipped({}), 0) << "a plain photograph needs every stage: this test is of no use";
  EXPECT_EQ(skipped({"--plan", "full"}), 0);
}

TEST(Fit, DebugPicturesStandInAFolderForEachPhotograph) {
  const fs::path folder = TestFolder();
  const std::string mayo = (SamplePhotos() / "mayo.jpg").string();
  const auto pictures = [&](const fs::path& in) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / in))
      if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  };
  MustFit(folder, {mayo, "--marker-mm", "25", "--debug", "one"});
  const std::vector<std::string> of_one = pictures("one");
  for (const char* stage : {"scale", "scene", "edge-upper", "edge-lower", "pivot"}) {
    EXPECT_TRUE(std::ranges::any_of(of_one, [&](const std::string& name) {
      return name.find(stage) != std::string::npos;
    })) << stage;
  }
  WriteText(folder / "one" / "99_scene.png", "of an earlier run");
  MustFit(folder, {mayo, "--marker-mm", "25", "--debug", "one"});
  EXPECT_EQ(pictures("one"), of_one) << "what an earlier run left is taken for this one's";
  MustFit(
      folder,
      {mayo, (SamplePhotos() / "mayo_wide.jpg").string(), "--marker-mm", "25", "--debug", "two"});
  EXPECT_EQ(pictures("two/1_mayo"), of_one);
  EXPECT_FALSE(pictures("two/2_mayo_wide").empty());
}

// As the wrong unit of a scale makes it.
TEST(Fit, WarnsOfBladesThatNoScissorsHave) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const auto warns = [&](double times) {
    const double mm_per_px = times * PhotoFromAbove().truth.mm_per_px;
    const Json record = MustFit(folder, {"scissors.jpg", "--mm-per-px", std::to_string(mm_per_px)});
    return std::ranges::count(record["warnings"], Json("size_unusual")) == 1;
  };
  EXPECT_FALSE(warns(1));
  EXPECT_TRUE(warns(10));
  EXPECT_TRUE(warns(0.05));
}

TEST(Fit, WarnsOfAnAngleThatIsVague) {
  constexpr double kQuarterDegree = 0.25 * kDegree;
  const fs::path folder = TestFolder();
  int vague = 0, plain = 0;
  for (const double scale : {1.0, 0.5, 0.25, 0.18}) {
    cv::Mat small;
    cv::resize(PhotoFromAbove().bgr, small, {}, scale, scale, cv::INTER_AREA);
    WriteText(folder / "scissors.jpg", JpegFile(small));
    const Json record = MustFit(folder, {"scissors.jpg", "--units", "px"});
    const bool is_vague = record["photos"][0]["theta_sigma_rad"] > kQuarterDegree;
    const bool warns = std::ranges::count(record["warnings"], Json("theta_vague")) == 1;
    EXPECT_EQ(warns, is_vague) << scale;
    ++(is_vague ? vague : plain);
  }
  EXPECT_GE(vague, 1);
  EXPECT_GE(plain, 1);
}

TEST(Fit, WithoutAScaleItIsRefused) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.png", PngFile(PhotoFromAbove().bgr, PngKind::kRgb8));
  const ProgramRun run = RunBladecurve({"fit", "scissors.png"}, folder);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.standard_output.find("\"no_scale\""), std::string::npos) << run.standard_output;
}

TEST(Fit, PixelsServeWhenAskedFor) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.png", PngFile(PhotoFromAbove().bgr, PngKind::kRgb8));
  const Json record = MustFit(folder, {"scissors.png", "--units", "px"});
  // The frame's axes are differences of pixel coordinates, good to 1e-13 of the picture's width.
  EXPECT_NEAR(record["photos"][0]["mm_per_px"].get<double>(), 1, 1e-9);
}

// The user's length runs from the pivot to the distal end: between the two that were found, it must
// come out.
TEST(Fit, KnownLengthGivesTheScale) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.png", PngFile(PhotoFromAbove().bgr, PngKind::kRgb8));
  const SceneTruth& truth = PhotoFromAbove().truth;
  const double length_mm = truth.upper.shape.to_mm;
  const Json record = MustFit(folder, {"scissors.png", "--length-mm", std::to_string(length_mm)});
  const Json& photo = record["photos"][0];
  const double found = photo["mm_per_px"], sigma = photo["mm_per_px_sigma"];
  const double reach_px = (PointOf(photo["upper_end_px"]) - PointOf(photo["pivot_px"])).norm();
  EXPECT_NEAR(found * reach_px, length_mm, 3 * sigma * reach_px);
  EXPECT_NEAR(found, truth.mm_per_px, 4 * sigma);
}

TEST(Fit, UnwritableResultIsAnErrorNamingTheFile) {
  const fs::path folder = TestFolder();
  WriteText(folder / "scissors.jpg", JpegFile(PhotoFromAbove().bgr));
  const ProgramRun run = RunBladecurve(
      {"fit", "scissors.jpg", "--mm-per-px", MmPerPx(), "-o", "no/such/folder/x"}, folder);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.standard_error.find("no/such/folder/x.blade.json"), std::string::npos)
      << run.standard_error;
}

}  // namespace
}  // namespace bladecurve
