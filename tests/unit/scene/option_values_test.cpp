#include "scene/option_values.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pounding {
namespace option_values_test {

using testing::ElementsAre;

TEST(OptionValues, NumbersAreFiniteAndWhole) {
  EXPECT_EQ(parse_real(" 1.5e-3 "), 1.5e-3);
  EXPECT_EQ(parse_real("+2"), 2);
  EXPECT_EQ(parse_real("-.5"), -0.5);
  for (const char* text :
       {"", "nan", "NaN", "inf", "-inf", "infinity", "1e999", "0,9", "1 2", "0x10", "3m", "+-1"}) {
    EXPECT_FALSE(parse_real(text)) << text;
  }
}

TEST(OptionValues, IntegersHaveNoFractionNoExponentAndFit) {
  EXPECT_EQ(parse_integer("12"), 12);
  EXPECT_EQ(parse_integer("-3"), -3);
  for (const char* text : {"", "12.0", "1e2", "99999999999", "twelve"}) {
    EXPECT_FALSE(parse_integer(text)) << text;
  }
}

TEST(OptionValues, BareFlagIsTrue) {
  EXPECT_EQ(parse_boolean(""), true);
  EXPECT_EQ(parse_boolean("Yes"), true);
  EXPECT_EQ(parse_boolean("1"), true);
  EXPECT_EQ(parse_boolean("OFF"), false);
  EXPECT_EQ(parse_boolean("0"), false);
  EXPECT_FALSE(parse_boolean("maybe"));
}

TEST(OptionValues, ListsOfNumbersHaveNoHoles) {
  EXPECT_THAT(*parse_reals("1, 0,-2e1"), ElementsAre(1, 0, -20));
  EXPECT_FALSE(parse_reals("1,,2"));
  EXPECT_FALSE(parse_reals("1,2,"));
  EXPECT_FALSE(parse_reals(""));
}

TEST(OptionValues, LogarithmicFrequenciesHaveOneRatio) {
  const auto f = parse_increasing("0.5:400:200log");
  ASSERT_TRUE(f);
  ASSERT_EQ(f->size(), 200U);
  EXPECT_EQ(f->front(), 0.5);
  EXPECT_EQ(f->back(), 400);
  const double ratio = std::pow(800.0, 1.0 / 199);
  for (std::size_t i = 1; i < f->size(); ++i) {
    EXPECT_NEAR((*f)[i] / (*f)[i - 1], ratio, 1e-12);
  }
}

TEST(OptionValues, LinearFrequenciesHaveOneDifference) {
  EXPECT_THAT(*parse_increasing("1:3:5lin"), ElementsAre(1, 1.5, 2, 2.5, 3));
  EXPECT_THAT(*parse_increasing("1,2,10"), ElementsAre(1, 2, 10));
  EXPECT_THAT(*parse_increasing("5"), ElementsAre(5));
}

TEST(OptionValues, FrequenciesIncrease) {
  for (const char* text : {"1,1", "2,1", "4:1:10log", "1:1:2lin", "0:4:10log", "1:4:1log", "1:4:10",
                           "1:4", "1:4:10cub", "1:4:2.5lin", "1:4:100001lin", "1:nan:4lin", ""}) {
    EXPECT_FALSE(parse_increasing(text)) << text;
  }
}

TEST(OptionValues, ShownValuesFitInALine) {
  EXPECT_EQ(shown_value("a\nb"), "a b");
  EXPECT_EQ(shown_value(" "), "(no value)");
  std::string shortened(80, 'x');
  shortened += "...";
  EXPECT_EQ(shown_value(std::string(500, 'x')), shortened);
}

TEST(OptionValues, PiecesAreTrimmed) {
  EXPECT_THAT(split(" a ,b c,", ','), ElementsAre("a", "b c", ""));
  EXPECT_THAT(split("", ','), ElementsAre(""));
}

}  // namespace option_values_test
}  // namespace pounding
