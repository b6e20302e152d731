#include "common/facts.h"

#include <gtest/gtest.h>

namespace pounding {
namespace facts_test {

const Json body{
    {"mass", 1234.56}, {"place", {1.0, 2.5, -3.0}}, {"gap", {0.001, 0.002}}, {"none", 0}};

TEST(Sentence, FillsSlotsInOrderAndByName) {
  EXPECT_EQ(told("{}: {mass:.0f} kg, {} of {}, y = {place/1}", body, {"floor", 3, 12U}),
            "floor: 1235 kg, 3 of 12, y = 2.5");
}

TEST(Sentence, PrintsAsPrintfDoes) {
  EXPECT_EQ(sentence("{:5d}|{:-6s}|{:10.3e}|{}", {42, "ab", 0.5, 1.0 / 3}),
            "   42|ab    | 5.000e-01|0.333333");
  EXPECT_EQ(sentence("{:.0f} {:d}", {7, std::int64_t{1} << 40}), "7 1099511627776");
}

TEST(Sentence, ConvertsFromSiIntoTheUnitOfTheReport) {
  EXPECT_EQ(sentence("{:.4g mm}, {:.4g kN}, {:.3g %}, {:.0f MB}", {0.0123, 4560.0, 0.05, 7e6}),
            "12.3 mm, 4.56 kN, 5 %, 7 MB");
  EXPECT_EQ(sentence("{:8.2f [mm]}|", {0.0123}), "   12.30|");
  EXPECT_THROW(sentence("{:.4g furlong}", {1.0}), std::logic_error);
}

TEST(Sentence, PrintsRangesAndVectors) {
  EXPECT_EQ(told("{gap:.3g mm} at {place:.6g} m", body), "1 to 2 mm at (1, 2.5, -3) m");
}

TEST(Sentence, LeavesOutAPartWhoseFirstValueIsNothing) {
  EXPECT_EQ(told("it[, mass {mass:.0f}][, {none} holes of {}][, in {group}], {}", body, {1, 2}),
            "it, mass 1235, 2");
  EXPECT_EQ(sentence("[{} at {}]", {1, 0}), "1 at 0");
}

TEST(Sentence, KeepsBracketsWithoutSlots) {
  EXPECT_EQ(told("energy [J]: {mass:.3g}", body), "energy [J]: 1.23e+03");
}

TEST(Sentence, ConversionOfAnotherKindGivesWayToThePlainOne) {
  EXPECT_EQ(sentence("{:.3f} {:5d}", {"word", 0.25}), "word 0.25");
}

TEST(Facts, HaveAValueAndTellIt) {
  Facts facts;
  facts.add("length", 0.25, "{length:.0f mm} long\n");
  Facts whole;
  whole.add("beam", facts);
  EXPECT_EQ(whole.values.dump(), R"({"beam":{"length":0.25}})");
  EXPECT_EQ(whole.text, "250 mm long\n");
}

TEST(Facts, NothingIsNullEmptyOrZero) {
  const Json kept = without_nothing(
      {{"a", 0.0}, {"b", ""}, {"c", {0, 0}}, {"d", false}, {"e", nullptr}, {"f", {0, 1}}});
  EXPECT_EQ(kept.dump(), R"({"f":[0,1]})");
}

}  // namespace facts_test
}  // namespace pounding
