// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Materials found again in simulated logs with an encoder's steps and a force sensor's noise.
#include "model/identify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/deformation_ramp.h"
#include "model/torque.h"
#include "tests/model/cutting_scenes.h"
#include "tests/model/logged_cuts.h"

namespace bladecurve {
namespace {

constexpr double kToughnessError = 0.02, kStiffnessError = 0.05;  // what is promised

struct Experiment {
  Rig rig;
  BladeFile blade{"small", SmallMetzenbaum()};  // that identifies
  BladeCurve true_blade = SmallMetzenbaum();    // that cuts
  Material material = PaperMaterials()[0];
  PlateSpan span{45, 68};
  int cuts = 5, empties = 5;
  Fluctuation fluctuation;
};

ForceLog Parsed(const std::string& csv, const std::string& name, const Rig& rig) {
  return ForceLogOfTable(ParseNumberTable(csv, name), rig.radius_mm);
}

IdentifyInput Logs(const Experiment& e, std::mt19937& random) {
  IdentifyInput input{{}, {}, e.blade, e.span, e.material.thickness_mm};
  for (int i = 0; i < e.cuts; ++i) {
    const std::string csv =
        LogOfCut(e.rig, e.true_blade, e.material, e.span, random, e.fluctuation);
    input.cuts.push_back(Parsed(csv, "cut.csv", e.rig));
  }
  for (int i = 0; i < e.empties; ++i)
    input.empties.push_back(Parsed(LogOfEmptyRun(e.rig, random), "empty.csv", e.rig));
  return input;
}

double TrueStiffness(const Experiment& e) {
  return e.material.force_deflection.initial_stiffness_n_per_mm();
}

void ExpectPromised(const Experiment& e, const Identification& found, const std::string& scene) {
  EXPECT_NEAR(found.toughness_n_per_mm.mean / e.material.toughness_n_per_mm, 1, kToughnessError)
      << scene;
  EXPECT_NEAR(found.stiffness_n_per_mm.mean / TrueStiffness(e), 1, kStiffnessError) << scene;
}

TEST(IdentifyMaterial, FindsEveryMaterialOfThePaperAgain) {
  for (const Material& material : PaperMaterials()) {
    for (const double step_deg : {0.005, 0.02, 0.05}) {
      // Plastic is cut after a turn of 0.09 degrees: two such steps tell no slope within 5 %.
      if (step_deg > 0.02 && material.name == "plastic") continue;
      for (std::uint32_t seed = 0; seed < 2; ++seed) {
        Experiment e;
        e.material = material;
        e.rig = {.rate_hz = 1000, .encoder_step_deg = step_deg, .noise_n = 0.0125};
        std::mt19937 random(seed);
        ExpectPromised(e,
                       IdentifyMaterial(Logs(e, random)),
                       material.name + ", encoder step " + std::to_string(step_deg) + " deg");
      }
    }
  }
}

TEST(IdentifyMaterial, FindsAMaterialCutByACurvedBlade) {
  Experiment e;
  e.blade.curve = e.true_blade = CurvedBlade();
  e.span = {35, 60};
  e.rig.rate_hz = 1000;
  std::mt19937 random(1);
  for (const Material& material : PaperMaterials()) {
    e.material = material;
    ExpectPromised(e, IdentifyMaterial(Logs(e, random)), material.name);
  }
}

TEST(IdentifyMaterial, FindsToughnessWhateverTheFluctuation) {
  Experiment e;
  e.fluctuation = {0.3, 0.5, 1};
  std::mt19937 random(2);
  const Identification found = IdentifyMaterial(Logs(e, random));
  EXPECT_NEAR(found.toughness_n_per_mm.mean / e.material.toughness_n_per_mm, 1, kToughnessError);
}

TEST(IdentifyMaterial, TakesTheLengthOfACutThatEndsWithinThePlateFromPhi) {
  Experiment e;
  e.rig.to_deg = 12;
  std::mt19937 random(3);
  const Identification found = IdentifyMaterial(Logs(e, random));
  ExpectPromised(e, found, "half a plate");
  EXPECT_FALSE(found.cuts[0].phases.through);
  EXPECT_LT(found.cuts[0].length_mm, 20);
}

TEST(IdentifyMaterial, LocatesThePhases) {
  Experiment e;
  e.material = PaperMaterials()[3];
  TorqueModel model(e.true_blade, e.material, e.span);
  double contact_rad = 0, start_rad = 0, end_rad = 0;
  for (const Pose& pose : StraightMotion(30, 2, 2000)) {
    static_cast<void>(model.Step(pose.theta_rad, 0, 1e-3));
    for (const TorqueEvent& event : model.events()) {
      if (event.kind == TorqueEventKind::kContact) contact_rad = event.theta_rad;
      if (event.kind == TorqueEventKind::kCutStart) start_rad = event.theta_rad;
      if (event.kind == TorqueEventKind::kThrough) end_rad = event.theta_rad;
    }
  }
  std::mt19937 random(4);
  for (const IdentifiedCut& cut : IdentifyMaterial(Logs(e, random)).cuts) {
    constexpr double kNear = 0.1 * kDegree;
    EXPECT_NEAR(cut.phases.contact_rad, contact_rad, kNear);
    EXPECT_NEAR(cut.phases.start_rad, start_rad, kNear);
    EXPECT_NEAR(cut.phases.end_rad, end_rad, kNear);
    EXPECT_TRUE(cut.phases.through);
    EXPECT_NEAR(cut.length_by_phi_mm, cut.length_mm, 0.5);
  }
}

// How often two stated uncertainties hold the truth, and how the errors compare with them.
struct Coverage {
  int experiments = 0, toughness = 0, stiffness = 0;
  double toughness_squares = 0, stiffness_squares = 0;  // of errors over uncertainties

  void Add(const Experiment& e, const Identification& found) {
    const double j = (found.toughness_n_per_mm.mean - e.material.toughness_n_per_mm) /
                     found.toughness_n_per_mm.uncertainty;
    const double k =
        (found.stiffness_n_per_mm.mean - TrueStiffness(e)) / found.stiffness_n_per_mm.uncertainty;
    ++experiments;
    toughness += std::abs(j) <= 2;
    stiffness += std::abs(k) <= 2;
    toughness_squares += j * j;
    stiffness_squares += k * k;
  }
};

// 95 % less two standard errors of as many experiments; and uncertainties not thrice too large.
void ExpectHonest(const Coverage& c) {
  const double n = c.experiments, least = 0.95 - 2 * std::sqrt(0.95 * 0.05 / n);
  EXPECT_GE(c.toughness / n, least);
  EXPECT_GE(c.stiffness / n, least);
  EXPECT_GE(std::sqrt(c.toughness_squares / n), 0.33);
  EXPECT_GE(std::sqrt(c.stiffness_squares / n), 0.33);
}

Experiment RandomExperiment(std::mt19937& random) {
  Experiment e;
  e.material = PaperMaterials()[random() % 4];
  e.rig.rate_hz = e.material.name == "plastic" ? 1000 : 250;  // deflects by 0.02 mm, not 0.1 to 0.5
  e.rig.encoder_step_deg = Uniform(random, 0.002, 0.05);
  e.rig.noise_n = Uniform(random, 0.005, 0.02);
  e.rig.friction_scatter = Uniform(random, 0, 0.01);
  e.rig.friction_n = Uniform(random, 0, 2);
  e.cuts = 3 + static_cast<int>(random() % 3);
  e.empties = 3;
  return e;
}

TEST(IdentifyMaterial, TwiceTheUncertaintyHoldsTheTruthInNinetyFivePercent) {
  std::mt19937 random(5);
  Coverage coverage;
  for (int i = 0; i < 100; ++i) {
    const Experiment e = RandomExperiment(random);
    coverage.Add(e, IdentifyMaterial(Logs(e, random)));
  }
  ExpectHonest(coverage);
}

// a and b of a fit, which mostly turns about the middle of the edge.
constexpr double kSigmaA_mm = 0.1, kSigmaB = 0.002, kCorrelation = -0.9;

TEST(IdentifyMaterial, TheUncertaintyCoversThatOfTheBlade) {
  std::mt19937 random(6);
  Coverage coverage;
  double from_blade = 0;
  constexpr int kExperiments = 80;
  for (int i = 0; i < kExperiments; ++i) {
    Experiment e = RandomExperiment(random);
    e.rig.to_deg = 12;  // within the plate: the length of the cut rests on phi
    const double first = Gauss(random), second = Gauss(random);
    const double a_mm = -11 + kSigmaA_mm * first;
    const double b = 0.14 + kSigmaB * (kCorrelation * first +
                                       std::sqrt(1 - kCorrelation * kCorrelation) * second);
    e.blade.curve = BladeCurve(TaperedRectangle{a_mm, b, 0.5}, {0, 200, 0, 1.2});
    const double ab = kCorrelation * kSigmaA_mm * kSigmaB;
    e.blade.covariance = {
        kSigmaA_mm * kSigmaA_mm, ab, NAN, ab, kSigmaB * kSigmaB, NAN, NAN, NAN, NAN};
    const Identification found = IdentifyMaterial(Logs(e, random));
    from_blade += found.toughness_n_per_mm.from_blade / found.toughness_n_per_mm.uncertainty;
    coverage.Add(e, found);
  }
  ExpectHonest(coverage);
  EXPECT_GT(from_blade / kExperiments, 0.5) << "the blade hardly counts: the test says little";
}

TEST(IdentifyMaterial, NamesWhatItCannotKnow) {
  Experiment e;
  e.cuts = e.empties = 1;
  std::mt19937 random(7);
  const Identification one = IdentifyMaterial(Logs(e, random));
  EXPECT_TRUE(std::isnan(one.toughness_n_per_mm.uncertainty));
  EXPECT_EQ(one.doubts,
            (std::vector<std::string>{"one_cut", "one_empty_run", "blade_uncertainty_unknown"}));
  e.cuts = e.empties = 2;
  e.span.end_mm = 68;
  IdentifyInput misplaced = Logs(e, random);
  misplaced.span.end_mm = 72;
  const std::vector<std::string> doubts = IdentifyMaterial(misplaced).doubts;
  EXPECT_NE(std::find(doubts.begin(), doubts.end(), "length_mismatch"), doubts.end());
}

TEST(FitDeformationRamp, FindsBothBendsExactly) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const double contact = Uniform(random, -0.1, 0.1), width = Uniform(random, 0.05, 0.5);
    const double k = Uniform(random, 1, 20), slope = Uniform(random, -0.2, 0.5) * k;
    std::vector<DeformationRow> rows;
    for (int i = 0; i <= 1000; ++i) {
      const double d = contact + width * Uniform(random, -2, 3);
      const double force =
          k * std::clamp(d - contact, 0.0, width) + slope * std::max(d - contact - width, 0.0);
      rows.push_back({d, force});
    }
    const DeformationRamp ramp = FitDeformationRamp(rows, {contact + 0.6 * width, 1.3 * width});
    constexpr double kGrid = 1e-4;  // of the last refinement, and of the rows' spacing
    EXPECT_NEAR(ramp.contact_mm, contact, kGrid * width);
    EXPECT_NEAR(ramp.width_mm, width, kGrid * width);
    EXPECT_NEAR(ramp.stiffness_n_per_mm, k, kGrid * k);
  }
}

}  // namespace
}  // namespace bladecurve
