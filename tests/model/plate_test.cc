// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/plate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "model/material_file.h"
#include "tests/model/cutting_scenes.h"

namespace bladecurve {
namespace {

ForceDeflection RandomTable(std::mt19937& random) {
  std::vector<double> delta_mm = {0}, force_n = {0};
  for (int i = 0; i < 8; ++i) {
    delta_mm.push_back(delta_mm.back() + Uniform(random, 0.01, 1));
    force_n.push_back(force_n.back() + Uniform(random, 0.001, 5));
  }
  return {delta_mm, force_n};
}

TEST(ForceDeflection, OfATablePassesItsPointsAndNeverFalls) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const ForceDeflection g = RandomTable(random);
    for (std::size_t i = 0; i < g.delta_mm().size(); ++i) {
      EXPECT_NEAR(g.Eval(g.delta_mm()[i]).force_n, g.force_n()[i], 1e-12);
    }
    double last = 0;
    for (double delta_mm = 0; delta_mm < 1.2 * g.delta_mm().back(); delta_mm += 0.003) {
      EXPECT_GE(g.Eval(delta_mm).force_n, last - 1e-12);
      last = g.Eval(delta_mm).force_n;
    }
  }
}

TEST(ForceDeflection, HasTheSlopeOfItsCentralDifference) {
  constexpr double kStep_mm = 1e-5;
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const ForceDeflection g = RandomTable(random);
    const double delta_mm = Uniform(random, 0.001, g.delta_mm().back());
    const double slope =
        (g.Eval(delta_mm + kStep_mm).force_n - g.Eval(delta_mm - kStep_mm).force_n) /
        (2 * kStep_mm);
    // Of a C1 cubic: a knot within the step costs the jump of g'' times the step.
    EXPECT_NEAR(g.Eval(delta_mm).stiffness_n_per_mm, slope, 1e-3 * (1 + slope));
  }
}

TEST(ForceDeflection, RefusesWhatDoesNotAscend) {
  EXPECT_THROW(ForceDeflection(-1.0), std::invalid_argument);
  EXPECT_THROW(ForceDeflection(std::nan("")), std::invalid_argument);
  EXPECT_THROW(ForceDeflection({0, 1, 1}, {0, 1, 2}), std::invalid_argument);
  EXPECT_THROW(ForceDeflection({0, 1}, {0.5, 1}), std::invalid_argument);
  EXPECT_THROW(ForceDeflection({0}, {0}), std::invalid_argument);
}

TEST(MaterialFile, ReadsThePapersMaterials) {
  const char* files[] = {"paper", "plastic", "cloth", "chicken-skin"};
  for (std::size_t i = 0; i < 4; ++i) {
    const Material read = ReadMaterialFile(
        std::string(BLADECURVE_SOURCE_DIR "/samples/materials/") + files[i] + ".json");
    const Material expected = PaperMaterials()[i];
    EXPECT_EQ(read.name, expected.name);
    EXPECT_EQ(read.toughness_n_per_mm, expected.toughness_n_per_mm);
    EXPECT_EQ(read.thickness_mm, expected.thickness_mm);
    EXPECT_EQ(read.force_deflection.initial_stiffness_n_per_mm(),
              expected.force_deflection.initial_stiffness_n_per_mm());
  }
}

TEST(MaterialFile, NamesFileAndKeyOfWhatIsWrong) {
  const std::string texts[] = {
      "",
      "[]",
      R"({"format":"other"})",
      R"({"format":"bladecurve-material/1"})",
      R"({"format":"bladecurve-material/1","name":"a","toughness_kj_per_m2":"x","thickness_mm":1,"stiffness_n_per_mm":1})",
      R"({"format":"bladecurve-material/1","name":"a","toughness_kj_per_m2":1,"thickness_mm":-1,"stiffness_n_per_mm":1})",
      R"({"format":"bladecurve-material/1","name":"a","toughness_kj_per_m2":1,"thickness_mm":1,"force_deflection":3})"};
  for (const std::string& text : texts) {
    try {
      static_cast<void>(ParseMaterial(text, "m.json"));
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("m.json: ")) << error.what();
    }
  }
}

}  // namespace
}  // namespace bladecurve
