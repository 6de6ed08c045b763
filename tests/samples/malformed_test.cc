// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/samples/picture_files.h"
#include "tests/samples/program_run.h"

// Whatever file is given: the right code, one line that names the file and says what to do, never a
// crash.
namespace bladecurve {
namespace {

namespace fs = std::filesystem;

ProgramRun Fit(const fs::path& folder, const std::string& photo) {
  return RunBladecurve({"fit", photo, "--mm-per-px", "0.1", "-o", "result"}, folder);
}

void ExpectOneLineNaming(const std::string& text, const std::string& photo) {
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_NE(text.find(photo), std::string::npos) << text;
  EXPECT_NE(text.find(';'), std::string::npos) << "no remedy in: " << text;
}

void ExpectRefused(const ProgramRun& run, const std::string& photo, const std::string& reason) {
  EXPECT_EQ(run.exit_code, 3) << run.standard_error;
  ExpectOneLineNaming(run.standard_error, photo);
  const auto refusal = nlohmann::json::parse(run.standard_output, nullptr, false);
  ASSERT_TRUE(refusal.is_object()) << run.standard_output;
  EXPECT_EQ(refusal.value("format", ""), "bladecurve/1");
  EXPECT_EQ(refusal.value("status", ""), "refused");
  EXPECT_EQ(refusal.value("photo", ""), photo);
  EXPECT_NE(refusal.value("detail", ""), "");
  if (!reason.empty()) {
    EXPECT_EQ(refusal.value("reason", ""), reason);
  }
}

void ExpectFileRefused(const std::string& photo,
                       const std::string& bytes,
                       const std::string& reason) {
  const fs::path folder = TestFolder();
  WriteText(folder / photo, bytes);
  ExpectRefused(Fit(folder, photo), photo, reason);
  EXPECT_FALSE(fs::exists(folder / "result.blade.json")) << "a refusal must leave no result";
}

cv::Mat Blank(int width, int height) { return {height, width, CV_8UC3, cv::Scalar(230, 230, 230)}; }

// A mug from above: round, dark, with a handle.
cv::Mat Mug() {
  cv::Mat picture = Blank(800, 600);
  cv::circle(picture, {400, 300}, 160, cv::Scalar(60, 60, 60), cv::FILLED, cv::LINE_AA);
  cv::rectangle(picture, cv::Rect(540, 270, 120, 60), cv::Scalar(60, 60, 60), cv::FILLED);
  cv::circle(picture, {400, 300}, 130, cv::Scalar(110, 120, 130), cv::FILLED, cv::LINE_AA);
  return picture;
}

TEST(MalformedPhoto, MissingFileIsUnreadable) {
  ExpectRefused(Fit(TestFolder(), "missing.jpg"), "missing.jpg", "unreadable");
}

TEST(MalformedPhoto, DirectoryIsUnreadable) {
  const fs::path folder = TestFolder();
  fs::create_directory(folder / "photos.jpg");
  ExpectRefused(Fit(folder, "photos.jpg"), "photos.jpg", "unreadable");
}

TEST(MalformedPhoto, EmptyFileIsUnreadable) { ExpectFileRefused("empty.jpg", "", "unreadable"); }

TEST(MalformedPhoto, TruncatedJpegIsUnreadable) {
  const std::string whole = JpegFile(Mug());
  for (const double share : {0.02, 0.3, 0.9}) {
    const auto kept = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    ExpectFileRefused("truncated.jpg", whole.substr(0, kept), "unreadable");
  }
}

TEST(MalformedPhoto, TruncatedPngIsUnreadable) {
  const std::string whole = PngFile(Mug(), PngKind::kRgb8);
  ExpectFileRefused("truncated.png", whole.substr(0, whole.size() / 2), "unreadable");
}

TEST(MalformedPhoto, TextNamedJpgIsUnreadable) {
  ExpectFileRefused("notes.jpg", "blade 3: reground in May\n", "unreadable");
}

TEST(MalformedPhoto, OnePixelIsTooSmall) {
  ExpectFileRefused("dot.png", PngFile(Blank(1, 1), PngKind::kRgb8), "too_small");
}

TEST(MalformedPhoto, SliverIsRefused) {
  ExpectFileRefused("sliver.png", PngFile(Blank(20000, 20), PngKind::kRgb8), "");
}

TEST(MalformedPhoto, BlankPictureIsNotScissors) {
  ExpectFileRefused("blank.jpg", JpegFile(Blank(800, 600)), "not_scissors");
}

TEST(MalformedPhoto, PictureOfSomethingElseIsNotScissors) {
  ExpectFileRefused("mug.jpg", JpegFile(Mug()), "not_scissors");
}

TEST(MalformedPhoto, NameWithSpacesQuotesAndUmlautsIsNamedAsGiven) {
  ExpectFileRefused("it's a \"Schöne\" photo.jpg", "", "unreadable");
}

TEST(MalformedPhoto, NameThatIsNotUtf8IsRefusedWithoutACrash) {
  const fs::path folder = TestFolder();
  const ProgramRun run = Fit(folder, "caf\xe9.jpg");
  EXPECT_EQ(run.exit_code, 3) << run.standard_error;
  EXPECT_TRUE(nlohmann::json::accept(run.standard_output)) << run.standard_output;
}

TEST(MalformedPhoto, EveryPixelFormatIsDecoded) {
  const fs::path folder = TestFolder();
  for (const PngKind kind : {PngKind::kGrey8,
                             PngKind::kGrey16,
                             PngKind::kRgb16,
                             PngKind::kRgba8,
                             PngKind::kGreyAlpha8,
                             PngKind::kPalette}) {
    SCOPED_TRACE("PngKind " + std::to_string(static_cast<int>(kind)));
    WriteText(folder / "mug.png", PngFile(Mug(), kind));
    ExpectRefused(Fit(folder, "mug.png"), "mug.png", "not_scissors");
  }
  cv::Mat cmyk;
  cv::cvtColor(Mug(), cmyk, cv::COLOR_BGR2BGRA);
  WriteText(folder / "mug.jpg", JpegFile(cmyk));
  ExpectRefused(Fit(folder, "mug.jpg"), "mug.jpg", "not_scissors");
}

TEST(MalformedPhoto, MissingCameraFileIsNamed) {
  const fs::path folder = TestFolder();
  WriteText(folder / "mug.jpg", JpegFile(Mug()));
  const ProgramRun run =
      RunBladecurve({"fit", "mug.jpg", "--camera", "no-such.json", "--marker-mm", "20"}, folder);
  EXPECT_EQ(run.exit_code, 2);
  ExpectOneLineNaming(run.standard_error, "no-such.json");
}

}  // namespace
}  // namespace bladecurve
