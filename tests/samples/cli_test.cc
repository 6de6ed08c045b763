// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "samples/flag_values.h"
#include "samples/spelling.h"
#include "tests/samples/program_run.h"

namespace bladecurve {
namespace {

// Wrong use: code 2, nothing on standard output, one line that says what to do.
void ExpectWrongUse(const std::vector<std::string>& arguments, const std::string& hint) {
  const ProgramRun run = RunBladecurve(arguments, TestFolder());
  const std::string& message = run.standard_error;
  EXPECT_EQ(run.exit_code, 2) << message;
  EXPECT_EQ(run.standard_output, "");
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  EXPECT_NE(message.find(hint), std::string::npos) << message;
}

TEST(CommandLine, MistypedFlagGetsTheNearestOne) {
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-pixel", "0.1"}, "did you mean --mm-per-px?");
  ExpectWrongUse({"fit", "a.jpg", "--tetha-deg=30"}, "did you mean --theta-deg?");
  ExpectWrongUse({"fit", "a.jpg", "--thread", "2"}, "did you mean --threads?");
}

TEST(CommandLine, MistypedCommandGetsTheNearestOne) {
  ExpectWrongUse({"fti", "a.jpg"}, "did you mean fit?");
}

TEST(CommandLine, UnknownFlagWithoutNeighbourGetsNoGuess) {
  ExpectWrongUse({"fit", "a.jpg", "--xyzzy"}, "unknown flag --xyzzy (");
}

// Large photographs take half as long for it.
TEST(CommandLine, TakesItsMemoryInLargePagesAndKeepsIt) {
  setenv("MALLOC_CONF", "stats_print:true", 1);
  const std::string statistics = RunBladecurve({"--version"}, TestFolder()).standard_error;
  unsetenv("MALLOC_CONF");
  EXPECT_NE(statistics.find("opt.thp: \"always\""), std::string::npos) << statistics;
  EXPECT_NE(statistics.find("opt.dirty_decay_ms: -1"), std::string::npos) << statistics;
}

TEST(CommandLine, NothingAtAllPointsToHelp) { ExpectWrongUse({}, "--help"); }

TEST(CommandLine, FitWithoutPhotographIsWrongUse) { ExpectWrongUse({"fit"}, "PHOTO"); }

TEST(CommandLine, TwoScalesAreRefusedByName) {
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-px", "0.1", "--dpi", "300"}, "--mm-per-px and --dpi");
  ExpectWrongUse({"fit", "a.jpg", "--units", "px", "--marker-mm", "20"},
                 "--marker-mm and --units px");
}

TEST(CommandLine, ValuesThatCannotBeAreNamed) {
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-px", "abc"}, "--mm-per-px: 'abc' is not a number");
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-px", "-1"}, "--mm-per-px: must be above zero");
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-px", "nan"}, "--mm-per-px");
  ExpectWrongUse({"fit", "a.jpg", "--dpi", "0"}, "--dpi: must be above zero");
  ExpectWrongUse({"fit", "a.jpg", "--length-mm", "1e999"}, "--length-mm");
  ExpectWrongUse({"fit", "a.jpg", "--pivot", "10"}, "--pivot: wants X,Y");
  ExpectWrongUse({"fit", "a.jpg", "--roi", "0,0,0,5"}, "--roi width");
  ExpectWrongUse({"fit", "a.jpg", "--theta-deg", "0"}, "--theta-deg");
  ExpectWrongUse({"fit", "a.jpg", "--theta-deg", "20,30"}, "2 angles for 1 photographs");
  ExpectWrongUse({"fit", "a.jpg", "--degree", "6"}, "--degree: must be 1 to 5");
  ExpectWrongUse({"fit", "a.jpg", "--knots", "many"}, "--knots: 'many' is not a whole number");
  ExpectWrongUse({"fit", "a.jpg", "--family", "circle"}, "--family");
  ExpectWrongUse({"fit", "a.jpg", "--threads", "0"}, "--threads: must be above zero");
  ExpectWrongUse({"fit", "a.jpg", "--tips-toward", "north"}, "--tips-toward");
}

TEST(CommandLine, ValuesBeyondAllPicturesAreNamed) {
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-px", "1e6"}, "--mm-per-px: must lie between");
  ExpectWrongUse({"fit", "a.jpg", "--dpi", "1e-99"}, "--dpi: must lie between");
  ExpectWrongUse({"fit", "a.jpg", "--marker-mm", "1e99"}, "--marker-mm: must lie between");
  ExpectWrongUse({"fit", "a.jpg", "--theta-deg", "179"}, "--theta-deg: must lie between");
  ExpectWrongUse({"fit", "a.jpg", "--card", "default", "--print-scale", "97"},
                 "did you mean 0.97?");
  ExpectWrongUse({"fit", "a.jpg", "--card", "default", "--print-scale", "3"},
                 "--print-scale: must");
}

TEST(CommandLine, FlagsThatWouldBePassedOverAreNamed) {
  ExpectWrongUse({"fit", "a.jpg", "--marker-mm", "25", "--print-scale", "0.97"},
                 "--marker-mm has no use for it");
  ExpectWrongUse({"fit", "a.jpg", "--mm-per-px", "0.1", "--plane-height-mm", "2"},
                 "--mm-per-px has no use for it");
  ExpectWrongUse({"fit", "a.jpg", "--dpi", "600", "--camera", "c.json"}, "--dpi has no use for it");
  ExpectWrongUse({"validate", "a.blade.json", "--csv", "a.csv"}, "BLADE excludes --csv");
  ExpectWrongUse({"catalog", "photos", "--debug", "d"}, "unknown flag --debug");
  ExpectWrongUse({"catalog", "plan", "photos", "--threads", "2"},
                 "bladecurve catalog plan: unknown flag --threads (");
}

TEST(CommandLine, OutputsThatCannotBeAreNamedBeforeAnyWork) {
  ExpectWrongUse({"fit", "a.jpg", "-o", "-"}, "-o: '-' is no name");
  ExpectWrongUse({"fit", "a.jpg", "-o", ".blade.json"}, "is no name for files");
  ExpectWrongUse({"fit", "a.jpg", "--overlay", "a.jpg"}, "does not end in .png");
  ExpectWrongUse({"card", "-o", "card.gif"}, "ends in none of");
  ExpectWrongUse({"card", "-o", "card.png", "--dpi", "50"}, "--dpi: must lie between");
}

TEST(CommandLine, LostOutputIsAnError) {
  const ProgramRun run = RunBladecurve({"--help"}, TestFolder(), "/dev/full");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.standard_error.find("cannot write to standard output"), std::string::npos);
}

TEST(CommandLine, HelpAndVersionGoToStandardOutput) {
  for (const char* flag : {"--help", "--version"}) {
    const ProgramRun run = RunBladecurve({flag}, TestFolder());
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.standard_output.find("bladecurve"), std::string::npos);
    EXPECT_EQ(run.standard_error, "");
  }
}

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("abc", "abc"), 0);
  EXPECT_EQ(EditDistance("abc", "acb"), 1);
  EXPECT_EQ(EditDistance("abcd", "abd"), 1);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
}

TEST(EditDistance, IsSymmetric) {
  for (const auto& [a, b] :
       {std::pair("--theta", "--tetha-deg"), std::pair("", "x"), std::pair("pivot", "roi")}) {
    EXPECT_EQ(EditDistance(a, b), EditDistance(b, a)) << a << ' ' << b;
  }
}

TEST(NearestName, IsEmptyWhereNothingIsNear) {
  EXPECT_EQ(NearestName("--xyzzy", {"--roi", "--pivot"}), "");
  EXPECT_EQ(NearestName("--roi", {}), "");
}

TEST(ParseNumbers, TakesSignsAndExponents) {
  EXPECT_EQ(ParseNumbers("--f", "-1.5,+2,3e-2"), (std::vector<double>{-1.5, 2, 0.03}));
}

TEST(ParseNumbers, RefusesGapsSpacesAndInfinity) {
  for (const char* text : {"", ",", "1,", "1, 2", "inf", "1;2", "0x10", "1..2"}) {
    EXPECT_THROW((void)ParseNumbers("--f", text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace bladecurve
