#include <random>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/hysteresis_path.h"
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

/// The law of the section and that of both in series see the same force, whatever the way there.
TEST(YieldingBeams, KeepTheRuleOfTheSectionInSeries) {
  constexpr double elastic = 0.7;
  for (const HystereticRule rule :
       {HystereticRule::kinematic, HystereticRule::isotropic, HystereticRule::origin,
        HystereticRule::peak, HystereticRule::straight, HystereticRule::bending,
        HystereticRule::pinching}) {
    Hysteresis law;
    law.rule = rule;
    law.positive = law.negative = {{{1, 1}, {3, 2}, {8, 2.5}}, 0.05};
    law.unloading_exponent = rule == HystereticRule::bending ? 0.5 : 0.6;
    law.unloading_least = 0.4;
    law.pinch_force = 0.3;
    law.pinch_elongation = 0.6;
    const auto own = interactions::make_path(law);
    const auto both = interactions::make_path(in_series(law, elastic));
    std::vector<double> of_own(own->memory_size(), 0.0);
    std::vector<double> of_both(both->memory_size(), 0.0);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> reach(-1, 1);
    double at = 0;
    double total = 0;
    for (int i = 0; i < 200; ++i) {
      const double to = reach(random) * (1 + 0.06 * i);
      const double force = own->follow(at, to, of_own, 1).force;
      const double next = to + force / elastic;
      EXPECT_NEAR(both->follow(total, next, of_both, 1).force, force, 1e-10)
          << static_cast<int>(rule) << ", " << i;
      at = to;
      total = next;
    }
  }
}

}  // namespace yielding_beams_test
}  // namespace pounding
