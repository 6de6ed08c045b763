// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Logs that will not do are refused by name, and the steps of an encoder evened out.
#include "model/force_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "model/identify.h"
#include "tests/model/cutting_scenes.h"
#include "tests/model/logged_cuts.h"

namespace bladecurve {
namespace {

constexpr double kRadius_mm = 98;

std::string CutCsv(const Rig& rig = {}) {
  std::mt19937 random(1);
  return LogOfCut(rig, SmallMetzenbaum(), PaperMaterials()[0], kCutSpan, random);
}

std::string EmptyCsv(const Rig& rig = {}) {
  std::mt19937 random(2);
  return LogOfEmptyRun(rig, random);
}

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string Text(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void IdentifyFrom(const std::string& cut_csv, const std::string& empty_csv) {
  const auto log = [](const std::string& csv, const std::string& name) {
    return ForceLogOfTable(ParseNumberTable(csv, name), kRadius_mm);
  };
  static_cast<void>(IdentifyMaterial({{log(cut_csv, "cut.csv")},
                                      {log(empty_csv, "empty.csv")},
                                      {"small", SmallMetzenbaum()},
                                      kCutSpan,
                                      0.1}));
}

void ExpectRefused(const std::string& cut_csv,
                   const std::string& empty_csv,
                   const std::string& code,
                   const std::string& words) {
  try {
    IdentifyFrom(cut_csv, empty_csv);
    ADD_FAILURE() << "not refused: " << words;
  } catch (const LogRefused& refusal) {
    EXPECT_EQ(refusal.code(), code) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find(words), std::string::npos) << refusal.what();
  }
}

TEST(ForceLog, OfAGoodCutIsTaken) { EXPECT_NO_THROW(IdentifyFrom(CutCsv(), EmptyCsv())); }

TEST(ForceLog, RowsOutOfOrderAreNamedByLine) {
  std::vector<std::string> swapped = Lines(CutCsv());
  std::swap(swapped[1000], swapped[1003]);  // lines 1001 and 1004: time falls at 1002
  ExpectRefused(Text(swapped), EmptyCsv(), "unsorted", "cut.csv:1002: t_s");
  std::vector<std::string> doubled = Lines(EmptyCsv());
  doubled[500] = doubled[499];
  ExpectRefused(CutCsv(), Text(doubled), "unsorted", "empty.csv:501: t_s");
}

TEST(ForceLog, ScissorsThatOpenAgainAreNamedByLine) {
  std::string csv = "theta_deg,torque_nmm\n";
  for (int i = 0; i < 200; ++i)
    csv += NumberText(i < 150 ? 30 - 0.1 * i : 15 + 0.1 * (i - 150)) + ",1\n";
  ExpectRefused(csv, EmptyCsv(), "unsorted", "cut.csv:157: the scissors open");
}

TEST(ForceLog, TheEndOfASensorsRangeIsNamedByLine) {
  for (const double force_step_n : {0.0, 0.0125}) {
    Rig rig;
    rig.force_step_n = force_step_n;
    std::vector<std::string> clipped = Lines(CutCsv(rig));
    for (std::size_t i = 1; i < clipped.size(); ++i) {
      const std::size_t comma = clipped[i].rfind(',');
      if (std::stod(clipped[i].substr(comma + 1)) > 1.9)
        clipped[i].replace(comma, std::string::npos, ",1.9");
    }
    ExpectRefused(Text(clipped), EmptyCsv(), "saturated", "the sensor is at the end of its range");
  }
}

TEST(ForceLog, ACoarseSensorIsNotTakenForASaturatedOne) {
  Rig rig;
  rig.noise_n = 0;
  rig.force_step_n = 0.0125;  // 1/80 N
  EXPECT_NO_THROW(IdentifyFrom(CutCsv(rig), EmptyCsv(rig)));
}

TEST(ForceLog, WhatIsMissingIsSaid) {
  Rig closed, ajar, inside, shallow;
  closed.from_deg = 20;
  ajar.to_deg = 25.7;
  inside.from_deg = 25.8;
  shallow.rate_hz = 1;
  const std::vector<std::string> all = Lines(CutCsv());
  ExpectRefused(Text({all.begin(), all.begin() + 40}), EmptyCsv(), "too_short", "cut.csv: 39 rows");
  ExpectRefused(CutCsv(closed), EmptyCsv(), "too_short", "cut.csv: begins when");
  ExpectRefused(CutCsv(ajar), EmptyCsv(), "no_cut", "cut.csv: no cut");
  ExpectRefused(CutCsv(), EmptyCsv(closed), "too_short", "empty.csv: the empty run goes from 20");
  ExpectRefused(EmptyCsv(), EmptyCsv(), "no_cut", "cut.csv: no cut");
}

TEST(ForceLog, WantsTheColumnsItNeeds) {
  ExpectRefused(
      "t_s,theta_deg\n0,1\n1,0\n", EmptyCsv(), "unreadable", "cut.csv:1: no number column force_n");
  ExpectRefused(
      "t_s,force_n\n0,1\n1,0\n", EmptyCsv(), "unreadable", "cut.csv:1: no number column theta_deg");
  const NumberTable table = ParseNumberTable(CutCsv(), "cut.csv");
  EXPECT_THROW(static_cast<void>(ForceLogOfTable(table, NAN)), std::invalid_argument);
}

TEST(ForceLog, OfAFileThatIsNoTableIsUnreadable) {
  try {
    static_cast<void>(ReadForceLog("no/such/file.csv", kRadius_mm));
    ADD_FAILURE();
  } catch (const LogRefused& refusal) {
    EXPECT_EQ(refusal.code(), "unreadable");
  }
}

TEST(ForceLog, ReadsAscendingAnglesWithoutTimeBackwards) {
  std::string falling = "theta_deg,torque_nmm\n", rising = falling;
  for (int i = 0; i < 100; ++i) {
    falling += NumberText(30 - 0.25 * i) + "," + NumberText(i) + "\n";
    rising += NumberText(30 - 0.25 * (99 - i)) + "," + NumberText(99 - i) + "\n";
  }
  const ForceLog a = ForceLogOfTable(ParseNumberTable(falling, "a"), NAN);
  const ForceLog b = ForceLogOfTable(ParseNumberTable(rising, "b"), NAN);
  EXPECT_EQ(a.theta_rad, b.theta_rad);
  EXPECT_EQ(a.torque_nmm, b.torque_nmm);
}

TEST(EvenedAngles, FollowASteadyTurnBetweenTheStepsOfAnEncoder) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const double step = Uniform(random, 3, 40), offset = Uniform(random, 0, 1);  // in rows
    std::vector<double> time, reading;
    for (int i = 0; i < 1000; ++i) {
      time.push_back(i);
      reading.push_back(-std::round(i / step + offset));
    }
    const std::vector<double> evened = EvenedAngles(time, reading);
    constexpr double kRow = 1.5;  // a jump is seen within half a row; at the ends it goes on
    for (int i = 0; i < 1000; ++i)
      EXPECT_NEAR(evened[static_cast<std::size_t>(i)], -(i / step + offset), kRow / step) << i;
  }
}

TEST(EvenedAngles, LeaveAFineEncoderAlone) {
  std::mt19937 random(4);
  std::vector<double> time, reading;
  for (int i = 0; i < 500; ++i) {
    time.push_back(i);
    reading.push_back(-i + Uniform(random, -0.2, 0.2));
  }
  EXPECT_EQ(EvenedAngles(time, reading), reading);
}

}  // namespace
}  // namespace bladecurve
