#include "common/saved_state.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "common/error.h"
#include "support/refusal.h"

namespace pounding {
namespace saved_state_test {

TEST(SavedState, GivesBackWhatWasPut) {
  SavedState saved("here");
  saved.put("step", {12345678901.0});
  saved.put("table", std::vector<double>{1, 2, 3, 4, 5, 6}, 3);
  saved.put_sums("sums", std::vector<double>{7, 8});
  saved.put_dofs(1, "velocity", std::vector<double>{9, 10});
  EXPECT_EQ(saved.integer("step"), 12345678901);
  EXPECT_EQ(saved.table("table", 3), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  std::vector<double> two(2);
  saved.get_sums("sums", two);
  EXPECT_EQ(two, (std::vector<double>{7, 8}));
  saved.get_dofs(1, "velocity", two);
  EXPECT_EQ(two, (std::vector<double>{9, 10}));
}

TEST(SavedState, RefusesWhatIsMissingOrOfAnotherSizeByName) {
  SavedState saved("file.h5");
  saved.put("table", std::vector<double>{1, 2, 3, 4}, 2);
  saved.put_sums("sums", std::vector<double>{7, 8});
  saved.put_dofs(0, "velocity", std::vector<double>{9, 10});
  std::vector<double> three(3);
  EXPECT_THROW(saved.number("step"), UserError);
  EXPECT_THROW(saved.get("table", three), UserError);
  EXPECT_THROW(saved.table("table", 4), UserError);
  EXPECT_THROW(saved.get_sums("sums", three), UserError);
  EXPECT_THROW(saved.get_dofs(0, "velocity", three), UserError);
  EXPECT_THROW(saved.get_dofs(1, "velocity", three), UserError);
  EXPECT_EQ(testing_support::refusal_of([&] { saved.number("step"); }).find("file.h5: 'step'"), 0u);
}

TEST(SavedState, KnowsWhetherDofsAreFinite) {
  SavedState saved;
  saved.put_dofs(0, "velocity", std::vector<double>{1, -1e300});
  EXPECT_TRUE(saved.dofs_are_finite());
  saved.put_dofs(1, "velocity", std::vector<double>{0, std::nan("")});
  EXPECT_FALSE(saved.dofs_are_finite());
  saved.put_dofs(1, "velocity", std::vector<double>{std::numeric_limits<double>::infinity()});
  EXPECT_FALSE(saved.dofs_are_finite());
}

}  // namespace saved_state_test
}  // namespace pounding
