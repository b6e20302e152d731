#include <gtest/gtest.h>

#include "scene/option_values.h"

namespace pounding {
namespace nearest_name_test {

TEST(NearestName, DistanceCountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", "gap"), 3);
  EXPECT_EQ(edit_distance("gap", "gap"), 0);
  EXPECT_EQ(edit_distance("gap", "gasp"), 1);
  EXPECT_EQ(edit_distance("gap", "ga"), 1);
  EXPECT_EQ(edit_distance("gap", "gop"), 1);
  EXPECT_EQ(edit_distance("gap", "gpa"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("Gap", "gap"), 1);
}

TEST(NearestName, DistanceIsSymmetric) {
  EXPECT_EQ(edit_distance("dampng_beta", "damping_alpha"),
            edit_distance("damping_alpha", "dampng_beta"));
}

TEST(NearestName, NearestOfSeveral) {
  EXPECT_EQ(nearest_name("s1_dampng_beta", {"s1_damping_alpha", "s1_damping_beta", "s2_mesh"}),
            "s1_damping_beta");
}

TEST(NearestName, NothingWhereNothingIsNear) {
  EXPECT_FALSE(nearest_name("colour", {"courant", "contacts", "output"}));
  EXPECT_FALSE(nearest_name("courant", {}));
  EXPECT_EQ(suggestion("colour", {"output"}), "");
}

TEST(NearestName, SuggestionIsAQuestion) {
  EXPECT_EQ(suggestion("concret", {"steel", "concrete"}), "; did you mean concrete?");
}

}  // namespace nearest_name_test
}  // namespace pounding
