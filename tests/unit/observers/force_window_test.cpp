#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "observers/impact_catalogue.h"

namespace pounding {
namespace force_window_test {

struct Step {
  double start, end, impulse;
};

/// Impulse until `time`.
double impulse_until(const std::vector<Step>& steps, double time) {
  double sum = 0;
  for (const Step& step : steps) {
    const double share = (time - step.start) / (step.end - step.start);
    sum += std::clamp(share, 0.0, 1.0) * step.impulse;
  }
  return sum;
}

/// Every time that begins or ends where a step does.
double by_search(const std::vector<Step>& steps, double length) {
  double most = 0;
  for (const Step& step : steps) {
    for (const double start : {step.start, step.end - length, step.end, step.start - length}) {
      most = std::max(most, impulse_until(steps, start + length) - impulse_until(steps, start));
    }
  }
  return most / length;
}

TEST(ForceWindow, IsTheLargestOfAllTimesOfItsLength) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(0, 1);
  for (const double length : {0.3, 1.0, 3.7, 25.0, 1000.0}) {
    ForceWindow window(length, 1);
    std::vector<Step> steps;
    double time = 0;
    for (int n = 0; n < 300; ++n) {
      if (size(random) < 0.2) time += std::floor(40 * std::pow(size(random), 4));  // no contact
      steps.push_back({time, time + 1, std::pow(size(random), 3)});
      window.add(steps.back().start, steps.back().end, steps.back().impulse);
      time += 1;
      ASSERT_NEAR(window.largest(), by_search(steps, length), 1e-11) << length << ", step " << n;
    }
  }
}

/// A force of half a sine over 5 ms in steps: the largest mean over 1 ms is known, the largest
/// impulse of a step over it follows the step where the steps are impulses apart.
TEST(ForceWindow, HasALimitWhereThePeakOfAStepHasNone) {
  const double duration = 5e-3, pi = std::acos(-1.0);
  const double exact = 2 * duration / pi / 1e-3 * std::sin(pi * 1e-3 / (2 * duration));
  for (const double step : {1e-4, 1e-5, 1.3e-6}) {
    ForceWindow window(1e-3, step);
    double peak = 0;
    for (int n = 0; n * step < duration; n += 4) {  // touches in every fourth step only
      const double impulse = 4 * step * std::sin(pi * (n + 2) * step / duration);
      window.add(n * step, n * step + step, impulse);
      peak = std::max(peak, impulse / step);
    }
    EXPECT_NEAR(window.largest() / exact, 1, step < 5e-5 ? 0.01 : 0.2) << step;
    EXPECT_NEAR(peak, 4, 0.01);
  }
}

TEST(ForceWindow, GoesOnToTheBit) {
  ForceWindow whole(1e-3, 1e-4), before(1e-3, 1e-4), after(1e-3, 1e-4);
  const auto add = [](ForceWindow& window, int n) {
    window.add(n * 1e-4, n * 1e-4 + 1e-4, 1 + std::sin(0.37 * n));
  };
  for (int n = 0; n < 57; ++n) {
    add(whole, n);
    add(before, n);
  }
  SavedState saved;
  before.keep("window", StateKeeper::to(saved));
  EXPECT_LE(saved.table("window", 4).size(), 14u * 4);  // no more than what the length needs
  after.keep("window", StateKeeper::from(saved));
  for (int n = 57; n < 200; ++n) {
    add(whole, n);
    add(after, n);
    ASSERT_EQ(after.largest(), whole.largest()) << n;
  }
  whole.reset();
  EXPECT_EQ(whole.largest(), 0);
}

}  // namespace force_window_test
}  // namespace pounding
