// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
#include "model/number_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bladecurve {
namespace {

TEST(NumberTable, ReadsEverySeparatorCommentsAndWords) {
  for (const char* text : {"a,b,word\n# note\n1,2.5,x\n\n-3,+4e-1,y\n",
                           "a;b;word\r\n1;2.5;x\r\n-3;0.4;y\r\n",
                           "\xEF\xBB\xBF"
                           "a\tb\tword\n1\t2.5\tx\n-3\t0.4\ty"}) {
    const NumberTable table = ParseNumberTable(text, "t.csv");
    EXPECT_EQ(table.Get("a"), (std::vector<double>{1, -3}));
    EXPECT_EQ(table.Get("b"), (std::vector<double>{2.5, 0.4}));
    EXPECT_EQ(table.Find("word"), nullptr);
  }
}

TEST(NumberTable, NamesTheLineOfWhatIsWrong) {
  const char* texts[] = {"a,b\n1,2\n3,x\n", "a,b\n1,2\n3\n", "a,b\n1,2\n3,nan\n"};
  for (const char* text : texts) {
    try {
      static_cast<void>(ParseNumberTable(text, "t.csv"));
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("t.csv:3: ")) << error.what();
    }
  }
  EXPECT_THROW(static_cast<void>(ParseNumberTable("", "t.csv")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(ParseNumberTable("a,b\n", "t.csv")), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(ReadNumberTable("/")), std::invalid_argument);
}

TEST(NumberText, ReadsBackExactly) {
  for (const double value : {0.1, 1.0 / 3, 1e-300, -2.5e17})
    EXPECT_EQ(std::stod(NumberText(value)), value);
}

}  // namespace
}  // namespace bladecurve
