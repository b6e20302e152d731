#include <stdexcept>

#include <gtest/gtest.h>

#include "system/inelastic_laws.h"

namespace pounding {
namespace yielding_beams_test {

TEST(YieldingBeams, PutALawInSeriesWithTheBendingThatStaysElastic) {
  Hysteresis law;
  law.positive = {{{1, 2}, {4, 4}}, 0.5};
  law.negative = {{{1, 2}, {3, 1}}, 0};
  const Hysteresis found = in_series(law, 2);
  EXPECT_DOUBLE_EQ(found.first_slope(), 1);
  EXPECT_DOUBLE_EQ(found.positive.breaks[1].elongation, 6);
  EXPECT_DOUBLE_EQ(found.positive.breaks[1].force, 4);
  EXPECT_DOUBLE_EQ(found.positive.last_slope, 0.4);
  EXPECT_DOUBLE_EQ(found.negative.breaks[1].elongation, 3.5);
  EXPECT_THROW(in_series(law, 0.3), std::domain_error);  // falls by .5, unbends by .3
}

}  // namespace yielding_beams_test
}  // namespace pounding
