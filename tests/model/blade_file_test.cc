// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/blade_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/model/blade_file_complaint.h"
#include "tests/model/test_blades.h"

namespace bladecurve {
namespace {

namespace fs = std::filesystem;

// A folder that disappears with the test.
class BladeFiles : public testing::Test {
 protected:
  BladeFiles() : folder_(fs::path(testing::TempDir()) / fs::path("blade_file_test." + Name())) {
    fs::create_directories(folder_);
  }
  ~BladeFiles() override { fs::remove_all(folder_); }

  fs::path Write(const std::string& text) const {
    const fs::path path = folder_ / "blade.json";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  [[nodiscard]] fs::path folder() const { return folder_; }

 private:
  static std::string Name() {
    return testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  fs::path folder_;
};

const std::string kTapered =
    R"("curve":{"family":"tapered-rectangle","a_mm":-11,"b":0.14,"gain":0.5})";
const std::string kDomainJson = R"("domain":{"x_mm":[20,100],"theta_rad":[0,1]})";
const std::string kHead = R"("format":"bladecurve/1","name":"small")";

std::string Record(const std::string& members) { return "{" + members + "}"; }

TEST_F(BladeFiles, FourKeysAreEnough) {
  const BladeFile blade = ReadBladeFile(Write(Record(kHead + "," + kTapered + "," + kDomainJson)));
  EXPECT_EQ(blade.name, "small");
  EXPECT_EQ(blade.status, "ok");
  EXPECT_EQ(std::get<TaperedRectangle>(blade.curve.shape()).a_mm, -11);
  EXPECT_EQ(blade.curve.domain().x_max_mm, 100);
  EXPECT_TRUE(std::isnan(blade.fit_rms_mm));
}

TEST_F(BladeFiles, GainIsThePapersUnlessGiven) {
  const std::string curve = R"("curve":{"family":"tapered-rectangle","a_mm":1,"b":0})";
  const BladeFile blade = ReadBladeFile(Write(Record(kHead + "," + curve + "," + kDomainJson)));
  EXPECT_EQ(std::get<TaperedRectangle>(blade.curve.shape()).gain, 0.5);
}

TEST_F(BladeFiles, UnknownKeysAreLeftAlone) {
  const std::string extra = R"(,"made_by":{"x":[1,null]},"photos":[],"fit":null)";
  EXPECT_EQ(BladeFileComplaint(Write(Record(kHead + "," + kTapered + "," + kDomainJson + extra))),
            "");
}

TEST_F(BladeFiles, CovarianceIsOrderedByName) {
  const std::string covariance =
      R"(,"covariance":{"parameters":["b","other","a_mm"],"matrix":[[4,0,2],[0,1,0],[2,0,9]]})";
  const BladeFile blade =
      ReadBladeFile(Write(Record(kHead + "," + kTapered + "," + kDomainJson + covariance)));
  ASSERT_EQ(blade.covariance.size(), 9u);
  EXPECT_EQ(blade.covariance[0], 9);
  EXPECT_EQ(blade.covariance[1], 2);
  EXPECT_TRUE(std::isnan(blade.covariance[2]));
  EXPECT_EQ(blade.standard_errors[0], 3);
  EXPECT_EQ(blade.standard_errors[1], 2);
  EXPECT_TRUE(std::isnan(blade.standard_errors[2]));
}

TEST_F(BladeFiles, WhatIsWrittenReadsBackBitForBit) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    BladeFile blade = {"b\"\\\n\xc3\xa9", RandomBlade(random)};
    const std::size_t n = ParameterValues(blade.curve.shape()).size();
    blade.status = "review";
    blade.warnings = {"one", "two"};
    blade.covariance.assign(n * n, Uniform(random, 0, 1e-3));
    blade.fit_rms_mm = Uniform(random, 0, 1);
    const std::string text = BladeFileText(blade);
    const BladeFile again = ReadBladeFile(Write(text));
    EXPECT_EQ(BladeFileText(again), text);
    EXPECT_EQ(again.name, blade.name);
    EXPECT_EQ(ParameterValues(again.curve.shape()), ParameterValues(blade.curve.shape()));
    EXPECT_TRUE(SameBits(again.curve.Eval(50, 0.3), blade.curve.Eval(50, 0.3)));
  }
}

TEST_F(BladeFiles, StandardErrorsWithoutCovarianceAreKept) {
  BladeFile blade = {"plugin", {TaperedRectangle{-11, 0.14, 0.5}, {20, 100, 0, 1}}};
  blade.standard_errors = {0.25, 0.5, std::nan("")};
  const BladeFile again = ReadBladeFile(Write(BladeFileText(blade)));
  EXPECT_EQ(again.standard_errors[1], 0.5);
  EXPECT_TRUE(std::isnan(again.standard_errors[2]));
}

TEST_F(BladeFiles, ARefusalSaysThatThereIsNoCurve) {
  const std::string complaint = BladeFileComplaint(Write(
      R"({"format":"bladecurve/1","status":"refused","reason":"no_scale","detail":"no marker"})"));
  EXPECT_NE(complaint.find("no_scale: no marker"), std::string::npos) << complaint;
}

struct Malformed {
  std::string text, word;
};

TEST_F(BladeFiles, MalformedOnesAreRefusedOnOneLineByFileAndKey) {
  const std::string tail = "," + kTapered + "," + kDomainJson;
  const auto curve = [](const std::string& members) {
    return Record(kHead + R"(,"curve":{)" + members + "}," + kDomainJson);
  };
  const std::string spline = R"("family":"rigid-spline","degree":1,"knots_mm":[0,0,9,9])";
  const std::vector<Malformed> cases = {
      {"", "empty"},
      {"{", "line 1"},
      {"\x01\x02\xff\xfe", "JSON"},
      {"x,y\n1,2\n", "JSON"},
      {"[1,2]", "object"},
      {"null", "object"},
      {Record(kHead + "," + kDomainJson), "curve"},
      {Record(kHead + "," + kTapered), "domain"},
      {Record(R"("name":"x")" + tail), "format"},
      {Record(R"("format":"bladecurve/1")" + tail), "name"},
      {Record(R"("format":"bladecurve/2","name":"x")" + tail), "format"},
      {Record(R"("format":1,"name":"x")" + tail), "format"},
      {Record(R"("format":"bladecurve/1","name":7)" + tail), "name"},
      {Record(kHead + tail + R"(,"status":"fine")"), "status"},
      {Record(kHead + tail + R"(,"warnings":"one")"), "warnings"},
      {Record(kHead + tail + R"(,"covariance":[1])"), "covariance"},
      {Record(kHead + tail + R"(,"covariance":{"parameters":["b"],"matrix":[[1,2]]})"), "matrix"},
      {Record(kHead + tail + R"(,"fit":{"rms_mm":"x"})"), "fit.rms_mm"},
      {Record(kHead + R"(,"curve":"line",)" + kDomainJson), "curve"},
      {curve(R"("family":"circle")"), "curve.family"},
      {curve(R"("a_mm":1,"b":2)"), "curve.family"},
      {curve(R"("family":"tapered-rectangle","b":2)"), "curve.a_mm"},
      {curve(R"("family":"tapered-rectangle","a_mm":true,"b":2)"), "curve.a_mm"},
      {curve(R"("family":"tapered-rectangle","a_mm":1e999,"b":2)"), "overflow"},
      {curve(R"("family":"tapered-rectangle","a_mm":1e99,"b":2)"), "a_mm"},
      {curve(spline), "curve.coefficients_mm"},
      {curve(spline + R"(,"coefficients_mm":[1,"2"])"), "curve.coefficients_mm[1]"},
      {curve(spline + R"(,"coefficients_mm":[1,2,3])"), "knots_mm"},
      {curve(R"("family":"rigid-spline","degree":1.5,"knots_mm":[],"coefficients_mm":[])"),
       "curve.degree"},
      {curve(R"("family":"rigid-spline","degree":1e18,"knots_mm":[],"coefficients_mm":[])"),
       "curve.degree"},
      {Record(kHead + "," + kTapered + R"(,"domain":{"x_mm":[1],"theta_rad":[0,1]})"),
       "domain.x_mm"},
      {Record(kHead + "," + kTapered + R"(,"domain":{"x_mm":[1,2]})"), "domain.theta_rad"},
      {Record(kHead + "," + kTapered + R"(,"domain":{"x_mm":[2,1],"theta_rad":[0,1]})"), "x_mm"},
  };
  for (const Malformed& bad : cases) {
    const fs::path path = Write(bad.text);
    const std::string complaint = BladeFileComplaint(path);
    EXPECT_EQ(complaint.find(path.string() + ": "), 0u) << bad.text << " -> " << complaint;
    EXPECT_NE(complaint.find(bad.word), std::string::npos) << bad.text << " -> " << complaint;
    EXPECT_NE(complaint.find_first_of(";"), std::string::npos) << "no remedy: " << complaint;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }
}

TEST_F(BladeFiles, MissingFilesAndFoldersAreNamed) {
  EXPECT_NE(BladeFileComplaint(folder() / "none.json").find("no such file"), std::string::npos);
  EXPECT_NE(BladeFileComplaint(folder()).find("folder"), std::string::npos);
}

TEST_F(BladeFiles, TruncationsAndFlippedBytesNeverCrash) {
  const std::string text = Record(kHead + "," + kTapered + "," + kDomainJson);
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    std::string broken = text.substr(0, random() % (text.size() + 1));
    if (!broken.empty()) broken[random() % broken.size()] = static_cast<char>(random() % 256);
    const std::string complaint = BladeFileComplaint(Write(broken));
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }
}

}  // namespace
}  // namespace bladecurve
