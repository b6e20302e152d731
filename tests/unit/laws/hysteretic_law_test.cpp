#include "laws/hysteretic_law.h"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/hysteresis_path.h"
#include "laws/yield_law.h"

namespace pounding::interactions {
namespace hysteretic_law_test {

using Rule = HystereticRule;
using Table = std::vector<std::pair<double, double>>;  // elongation, force by hand

const std::vector<Rule> all_rules{Rule::kinematic, Rule::isotropic, Rule::origin,  Rule::peak,
                                  Rule::straight,  Rule::bending,   Rule::pinching};

/// Slopes 1, 1/2 and 0, corners at 1 and 3, in both directions.
Hysteresis three_slopes(Rule rule, double exponent = 0) {
  Hysteresis law;
  law.rule = rule;
  law.positive = law.negative = {{{1, 1}, {3, 2}}, 0};
  law.unloading_exponent = exponent;
  return law;
}

/// Follows a table by its path in one way from row to row, and by the law in steps of 1/1024.
void expect_table(const Hysteresis& law, const Table& table) {
  const auto path = make_path(law);
  std::vector<double> of_path(path->memory_size(), 0.0);
  const HystereticLaw stepped(law);
  std::vector<double> memory(stepped.memory_size(), 0.0);
  double at = 0;
  double lost = 0;
  for (const auto& [elongation, force] : table) {
    EXPECT_NEAR(path->follow(at, elongation, of_path, 1).force, force, 1e-12) << elongation;
    const int steps = static_cast<int>(std::ceil(std::abs(elongation - at) * 1024));
    for (int i = 1; i <= steps; ++i) {
      stepped.advance(at + (elongation - at) * i / steps, memory);
      EXPECT_GE(stepped.lost(memory), lost - 1e-13);
      lost = stepped.lost(memory);
    }
    EXPECT_NEAR(stepped.force(memory), force, 1e-11) << elongation;
    at = elongation;
  }
}

TEST(HystereticLaw, FollowsTablesMadeByHand) {
  expect_table(
      three_slopes(Rule::kinematic),
      {{4, 2}, {3, 1}, {2, 0}, {0, -1}, {-2, -2}, {-4, -2}, {-2, 0}, {0, 1}, {2, 2}, {4, 2}});
  expect_table(three_slopes(Rule::isotropic),
               {{2, 1.5}, {-1, -1.5}, {-2, -2}, {-3, -2}, {1, 2}, {3, 2}});
  expect_table(three_slopes(Rule::origin),
               {{3, 2}, {1.5, 1}, {-0.5, -0.5}, {-3, -2}, {4, 2}, {2, 1}, {-1.5, -1}});
  expect_table(three_slopes(Rule::peak), {{5, 2},
                                          {4, 1},
                                          {3, 0},
                                          {1, -0.5},
                                          {-1, -1},
                                          {-2, -1.5},
                                          {-0.5, 0},
                                          {2.25, 1},
                                          {1.25, 0},
                                          {0, -1.5 * 1.25 / 3.25},
                                          {-2, -1.5},
                                          {-3, -2}});
  const double unloading = std::sqrt(0.4);
  const double free = 5 - 2 / unloading;
  expect_table(three_slopes(Rule::peak, 0.5), {{5, 2}, {free, 0}, {-1, -1}});
  expect_table(
      three_slopes(Rule::straight),
      {{3, 2}, {0, -0.25}, {-1, -1}, {-2, -1.5}, {0, -0.1}, {3, 2}, {5, 2}, {1, 0}, {-2, -1.5}});
  expect_table(
      three_slopes(Rule::bending, 0.5),
      {{2, 1.5}, {-1, -1}, {2, 1.5}, {5, 2}, {free, 0}, {0, -free / (1 + free)}, {-1, -1}});
  Hysteresis pinching = three_slopes(Rule::pinching);
  pinching.pinch_force = 0.2;
  pinching.pinch_elongation = 0.5;
  expect_table(
      pinching,
      {{5, 2}, {3, 0}, {1, -0.5}, {-1, -1}, {-3, -2}, {-1, 0}, {2, 0.4}, {3.5, 1.2}, {5, 2}});
}

TEST(HystereticLaw, IsElasticUpToItsFirstCorner) {
  for (const Rule rule : all_rules) {
    Hysteresis law = three_slopes(rule, 0.3);
    law.pinch_force = 0.2;
    law.pinch_elongation = 0.5;
    law.negative.breaks.front() = {0.75, 0.75};
    const HystereticLaw stepped(law);
    std::vector<double> memory(stepped.memory_size(), 0.0);
    for (const double elongation : {0.5, -0.25, 1.0, -0.75, 0.25, 0.0, 0.9}) {
      stepped.advance(elongation, memory);
      EXPECT_NEAR(stepped.force(memory), elongation, 1e-15) << static_cast<int>(rule);
    }
    EXPECT_NEAR(stepped.lost(memory), 0, 1e-15) << static_cast<int>(rule);
    EXPECT_LE(stepped.ductility(memory), 1);
  }
}

TEST(HystereticLaw, SoftensAndDeterioratesByHand) {
  Hysteresis law;
  law.rule = Rule::peak;
  law.positive = law.negative = {{{1, 1}, {2, 1}, {4, 0.5}}, 0};
  expect_table(law, {{3, 0.75}, {2.25, 0}, {-1, -1}, {-3, -0.75}, {-2.25, 0}, {3, 0.75}, {6, 0.5}});
  law.positive = law.negative = {{{1, 1}}, 0};
  law.lasting_energy = 10;
  // Lost to the first passage 2, so .8 is left; to the second 1.68 of 8, so .8 x .79 is.
  expect_table(law, {{3, 1}, {2, 0}, {-1, -0.8}, {-2, -0.8}, {-1.2, 0}, {3, 0.632}});
}

TEST(HystereticLaw, OfOneDirectionLeavesAGap) {
  Hysteresis stop;
  stop.rule = Rule::peak;
  stop.positive = {{{1, 1}, {1.5, 0.75}}, 0};
  stop.unloading_exponent = 1;
  stop.unloading_least = 0.5;
  expect_table(stop, {{-2, 0},
                      {0.5, 0.5},
                      {-1, 0},
                      {4, 0.75},
                      {3, 0.25},
                      {2.5, 0},
                      {0, 0},
                      {2.5, 0},
                      {3.5, 0.5},
                      {4.5, 0.75}});
}

TEST(HystereticLaw, DiffersInItsTwoDirections) {
  Hysteresis brace = three_slopes(Rule::peak);
  brace.negative = {{{0.5, 0.5}, {1.5, 0.2}}, 0};
  expect_table(brace,
               {{-0.5, -0.5}, {-1.5, -0.2}, {-1.3, 0}, {1, 1}, {3, 2}, {1, 0}, {-1.5, -0.2}});
  Hysteresis sliders = three_slopes(Rule::kinematic);
  sliders.negative = {{{0.5, 0.5}, {1.5, 1}}, 0};
  expect_table(sliders, {{4, 2}, {2.5, 0.5}, {1.5, 0}, {-0.5, -1}, {-1, -1}});
}

/// Energy that a law loses from one largest elongation to the next, and the area of that loop.
std::pair<double, double> last_loop(const Hysteresis& parameters, double amplitude) {
  const HystereticLaw law(parameters);
  std::vector<double> memory(law.memory_size(), 0.0);
  constexpr double step = 0.125;  // meets every corner
  double at = 0, lost = 0, area = 0;
  for (int turn = 0; turn < 6; ++turn) {
    const double end = turn % 2 == 0 ? amplitude : -amplitude;
    if (turn == 1 || turn == 3) {
      lost = law.lost(memory);
      area = 0;
    }
    while (at != end) {
      const double before = law.force(memory);
      const double next = at + (at < end ? step : -step);
      law.advance(next, memory);
      area += (before + law.force(memory)) / 2 * (next - at);
      at = next;
    }
    if (turn == 4) break;
  }
  return {law.lost(memory) - lost, area};
}

TEST(HystereticLaw, LosesTheAreaOfItsClosedLoops) {
  Hysteresis pinching = three_slopes(Rule::pinching);
  pinching.pinch_force = 0.2;
  pinching.pinch_elongation = 0.5;
  // Of peak the parallelogram (5, 2) (3, 0) (-5, -2) (-3, 0), of pinching less two triangles with
  // corners (3, 0) (-5, -2) (-1, -.4).
  for (const auto& [law, by_hand] :
       {std::pair{three_slopes(Rule::kinematic), 20.0}, std::pair{three_slopes(Rule::peak), 12.0},
        std::pair{three_slopes(Rule::origin), 0.0}, std::pair{three_slopes(Rule::straight), 0.0},
        std::pair{pinching, 12 - 2 * 2.4}}) {
    const auto [lost, area] = last_loop(law, 5);
    EXPECT_NEAR(lost, by_hand, 1e-12) << static_cast<int>(law.rule);
    EXPECT_NEAR(area, by_hand, 1e-12) << static_cast<int>(law.rule);
  }
}

/// Random law of a rule, mostly with corners that the other direction does not have.
Hysteresis random_law(Rule rule, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  Hysteresis law;
  law.rule = rule;
  const double stiffness = std::pow(10, 4 * part(random) - 2);
  const bool may_soften = rule != Rule::kinematic;
  const int corners = 1 + static_cast<int>(4 * part(random));
  std::vector<double> slopes;
  double slope = stiffness;
  for (int i = 0; i < corners; ++i) {
    slope *= part(random);
    slopes.push_back(may_soften && part(random) < 0.3 ? -slope * part(random) : slope);
  }
  for (Skeleton* skeleton : {&law.positive, &law.negative}) {
    double elongation = 0.2 + part(random);
    double force = stiffness * elongation;
    skeleton->breaks.push_back({elongation, force});
    for (int i = 0; i + 1 < corners; ++i) {
      const double way = 0.1 + 2 * part(random);
      const double next = std::max(0.0, force + slopes[i] * way);
      elongation += way;
      force = std::min(next, force / (elongation - way) * elongation);
      skeleton->breaks.push_back({elongation, force});
    }
    skeleton->last_slope = std::clamp(slopes.back(), 0.0, force / elongation);
  }
  if (rule == Rule::kinematic) {  // slopes alike
    const double factor = 0.5 + part(random);
    law.negative = law.positive;
    for (SkeletonBreak& corner : law.negative.breaks) {
      corner.elongation *= factor;
      corner.force *= factor;
    }
  }
  const bool gap = rule == Rule::origin || rule == Rule::peak || rule == Rule::pinching;
  if (gap && part(random) < 0.2) law.negative = {};
  law.unloading_exponent = part(random) < 0.3 ? 0 : part(random);
  law.unloading_least = part(random) < 0.7 ? 0 : part(random);
  law.pinch_elongation = 0.1 + 0.8 * part(random);
  law.pinch_force = law.pinch_elongation * part(random);
  const bool weakens = rule == Rule::peak || rule == Rule::pinching;
  if (weakens && part(random) < 0.4) law.lasting_energy = stiffness * (1 + 100 * part(random));
  return law;
}

TEST(HystereticLaw, NeverGivesEnergyOnRandomWalks) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const Rule rule : all_rules) {
    for (int law_number = 0; law_number < 100; ++law_number) {
      const Hysteresis parameters = random_law(rule, random);
      const HystereticLaw law(parameters);
      std::vector<double> memory(law.memory_size(), 0.0);
      const double size = std::pow(10, -2.0 + 3 * (law_number % 10) / 9.0);
      double at = 0, work = 0, largest = 0;
      for (int n = 0; n < 10000; ++n) {
        const double to = n % 7 == 0 ? 3 * size * normal(random) : at + 0.2 * size * normal(random);
        const double before = law.force(memory);
        const double lost = law.lost(memory);
        law.advance(to, memory);
        work += (before + law.force(memory)) / 2 * (to - at);
        at = to;
        largest = std::max({largest, std::abs(law.stored(memory)), law.tangent() * to * to});
        ASSERT_GE(law.lost(memory), lost - 1e-13 * largest)
            << static_cast<int>(rule) << " " << law_number << " " << n;
        ASSERT_GE(law.stored(memory), 0);
      }
      EXPECT_NEAR(work, law.stored(memory) + law.lost(memory), 1e-9 * largest);
    }
  }
}

TEST(HystereticLaw, GivesNoEnergyWhereItsStrengthChanges) {
  std::mt19937 random(7);
  std::normal_distribution<double> way(0, 0.7);
  std::uniform_real_distribution<double> part(0.001, 1);
  const HystereticLaw law(three_slopes(Rule::kinematic));
  std::vector<double> memory(law.memory_size(), 0.0);
  double elongation = 0, lost = 0, largest = 0;
  for (int i = 0; i < 200000; ++i) {
    elongation = 0.95 * elongation + way(random);
    law.advance(elongation, memory, part(random));
    largest = std::max(largest, law.stored(memory));
    ASSERT_GE(law.lost(memory), lost - 1e-13 * largest) << i;
    lost = law.lost(memory);
  }
  EXPECT_GT(lost, 1e4);
  // Beyond both corners, weakened to a quarter: a quarter of 2.
  law.advance(elongation + 100, memory, 0.25);
  EXPECT_NEAR(law.force(memory), 0.5, 1e-12);
}

TEST(HystereticLaw, IsNowhereStifferThanAtFirstAndFallsOnlyWhereItsSkeletonDoes) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const Rule rule : all_rules) {
    for (int law_number = 0; law_number < 60; ++law_number) {
      const Hysteresis law = random_law(rule, random);
      bool falls = !std::isinf(law.lasting_energy);
      for (const Skeleton* skeleton : {&law.positive, &law.negative}) {
        for (std::size_t i = 1; i < skeleton->breaks.size(); ++i) {
          falls = falls || skeleton->breaks[i].force < skeleton->breaks[i - 1].force;
        }
      }
      const auto path = make_path(law);
      std::vector<double> memory(path->memory_size(), 0.0);
      const double stiffness = law.first_slope();
      double at = 0, force = 0;
      for (int n = 0; n < 3000; ++n) {
        const double to = n % 5 == 0 ? 2 * normal(random) : at + 0.05 * normal(random);
        const double next = path->follow(at, to, memory, 1).force;
        const double most = stiffness * std::abs(to - at);
        const double small = 1e-11 * (std::abs(force) + stiffness * (std::abs(at) + std::abs(to)));
        const double rise = to > at ? next - force : force - next;
        EXPECT_LE(rise, most + small) << static_cast<int>(rule);
        if (!falls) {
          EXPECT_GE(rise, -small) << static_cast<int>(rule);
        }
        at = to;
        force = next;
      }
    }
  }
}

TEST(HystereticLaw, OfTwoSlopesHardensAsABilinearLinkDoes) {
  Hysteresis bilinear;
  bilinear.positive = bilinear.negative = {{{0.1, 100}}, 200};
  const HystereticLaw law(bilinear);
  const YieldLaw known(1000, 0.2, 100);
  std::vector<double> memory(law.memory_size(), 0.0);
  std::vector<double> of_known(known.memory_size(), 0.0);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 0.2);
  double before = 0, now = 0;
  for (int n = 0; n < 10000; ++n) {
    const double after = now + normal(random);
    law.advance(now, memory);
    const double trial = std::abs(known.trial(now, of_known));
    known.yield(now, trial > known.capacity() ? known.capacity() / trial : 1, of_known);
    const double size = 1000 * (1 + std::abs(now) + std::abs(after));
    ASSERT_NEAR(law.force(memory), known.force(before, now, after, of_known), 1e-12 * size);
    known.remember(before, now, after, 1, of_known);
    ASSERT_NEAR(law.stored(memory) + law.force(memory) * (after - now) / 2,
                known.energy(now, after, of_known), 1e-12 * size * size);
    before = now;
    now = after;
  }
  EXPECT_GT(law.ductility(memory), 1);
}

}  // namespace hysteretic_law_test
}  // namespace pounding::interactions
