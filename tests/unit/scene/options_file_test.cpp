#include <gmock/gmock.h>

#include "common/error.h"
#include "scene/options_database.h"
#include "support/refusal.h"

namespace pounding {
namespace options_file_test {

OptionsDatabase read(const std::string& text) {
  return parse_options_file(text, "case.yaml");
}

/// The message of the refusal; "" when the text is accepted.
std::string refusal(const std::string& text) {
  return testing_support::refusal_of([&] { read(text); });
}

TEST(OptionsFile, NestedNamesJoin) {
  EXPECT_EQ(
      read("s1: {slab: {element: hex8}, mesh: a.geo}\nend_time: 2.5e1\n"),
      (OptionsDatabase{{"s1_slab_element", "hex8"}, {"s1_mesh", "a.geo"}, {"end_time", "2.5e1"}}));
}

TEST(OptionsFile, ValuesAreTheirText) {
  EXPECT_EQ(read("a: true\nb: yes\nc: ~\nd:\ne: null\nf: \"x: y # z\"\ng: 0x1F\nh: 'it''s'\n"),
            (OptionsDatabase{{"a", "true"},
                             {"b", "yes"},
                             {"c", "~"},
                             {"d", ""},
                             {"e", "null"},
                             {"f", "x: y # z"},
                             {"g", "0x1F"},
                             {"h", "it's"}}));
}

TEST(OptionsFile, ItemsOfListsJoinWithCommas) {
  EXPECT_EQ(read("contacts: [low, high]\ngap:\n  - 0.02\n  - 0.03\nnone: []\n"),
            (OptionsDatabase{{"contacts", "low,high"}, {"gap", "0.02,0.03"}, {"none", ""}}));
}

TEST(OptionsFile, AnchorsRepeatAndMerge) {
  EXPECT_EQ(read("$$c: &c {element: hex8, material: concrete}\n"
                 "s1: {slab: *c}\n"
                 "s2: {slab: {element: shell, <<: *c}}\n"),
            (OptionsDatabase{{"s1_slab_element", "hex8"},
                             {"s1_slab_material", "concrete"},
                             {"s2_slab_element", "shell"},
                             {"s2_slab_material", "concrete"}}));
}

TEST(OptionsFile, EarlierMergeWins) {
  EXPECT_EQ(read("$$a: &a {x: 1}\n$$b: &b {x: 2, y: 3}\ns: {<<: [*a, *b]}\n"),
            (OptionsDatabase{{"s_x", "1"}, {"s_y", "3"}}));
}

TEST(OptionsFile, NamesThatStandTwiceAreRefusedWithBothLines) {
  EXPECT_THAT(refusal("end_time: 1\ncourant: 1\nend_time: 2\n"),
              testing::AllOf(testing::HasSubstr("case.yaml, line 3, column 1"),
                             testing::HasSubstr("end_time is in line 1 already")));
  EXPECT_THAT(
      refusal("s1: {mesh: a}\n\ns1_mesh: b\n"),
      testing::AllOf(testing::HasSubstr("line 3"), testing::HasSubstr("s1_mesh is in line 1")));
  EXPECT_THAT(refusal("s1:\n  mesh: a\ns2: {}\ns1:\n  clamp: b\n"),
              testing::AllOf(testing::HasSubstr("line 4"), testing::HasSubstr("s1 is in line 1")));
  EXPECT_THAT(
      refusal("s1:\n  slab: {element: hex8}\n  slab: {element: shell}\n"),
      testing::AllOf(testing::HasSubstr("line 3"), testing::HasSubstr("s1_slab is in line 2")));
}

TEST(OptionsFile, WhatIsNotYamlIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal("s1: {mesh: a.geo\n  b: [\n"),
              testing::HasSubstr("case.yaml, line 2, column 4: not YAML"));
  EXPECT_THAT(refusal("a: 1\ns1:\n\tmesh: b\n"),
              testing::HasSubstr("line 3, column 1: not YAML: a tab"));
  EXPECT_THAT(refusal("a: 1\ns1:\n  \tmesh: b\n  c: d: e\n"), testing::HasSubstr("not YAML"));
  EXPECT_THAT(refusal("\xc3\xa9: 1\ns1:\n\tmesh: b\n"), testing::HasSubstr("a tab"));
  EXPECT_THAT(refusal("a: 1\nb: \x01\n"),
              testing::HasSubstr("line 2, column 4: not YAML: control"));
  EXPECT_EQ(parse_options_file("a: 1\nb\xf6: K\xf6ln\xf6\n", "f").at("b\xf6"), "K\xf6ln\xf6");
  EXPECT_THAT(refusal("a: 1\n\x01: 3\n"), testing::HasSubstr("line 2, column 1: not YAML"));
  EXPECT_THAT(refusal("a: *b\n"), testing::HasSubstr("line 1"));
}

TEST(OptionsFile, WhatHoldsNoOptionsIsRefused) {
  for (const char* text :
       {"", "\n\n", "# only a comment\n", "---\n", "~\n", "- a\n- b\n", "-end_time 3\n", "[]",
        "1: {[a]: b}\n", ": 3\n", "a: [[b], c]\n", "a: [{b: c}]\n", "<<: 3\na: b\n", "<<: [3]\n"}) {
    EXPECT_THAT(refusal(text), testing::HasSubstr("case.yaml")) << text;
  }
}

TEST(OptionsFile, ZeroCharacterIsRefused) {
  EXPECT_THAT(refusal("output: \"a\\0b\"\n"), testing::HasSubstr("zero character"));
}

TEST(OptionsFile, SecondDocumentIsRefused) {
  EXPECT_THAT(refusal("a: 1\n---\nb: 2\n"),
              testing::HasSubstr("line 3, column 1: a second document"));
  EXPECT_EQ(read("---\na: 1\n...\n"), (OptionsDatabase{{"a", "1"}}));
}

TEST(OptionsFile, AnchorsInsideThemselvesEnd) {
  EXPECT_THAT(refusal("a: &a {b: *a}\n"), testing::HasSubstr("nested too deep"));
  EXPECT_THAT(refusal("a: &a {<<: *a}\n"), testing::HasSubstr("nested too deep"));
  std::string laughs = "$$0: &a0 {x: 1, y: 2}\n";
  for (int i = 1; i < 14; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    laughs += "$$" + std::to_string(i) + ": &a" + std::to_string(i) + " {";
    for (int k = 0; k < 9; ++k) {
      laughs += "k" + std::to_string(k) + ": " + before + ", ";
    }
    laughs += "k: " + before + "}\n";
  }
  EXPECT_THAT(refusal(laughs + "all: *a13\n"), testing::HasSubstr("more than 100000 options"));
}

}  // namespace options_file_test
}  // namespace pounding
