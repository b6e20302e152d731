#include "motion/stretch_bound.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "motion/stretch_jump.h"

namespace pounding::oscillator {
namespace stretch_bound_test {

/// One oscillator through one stretch, looked at in 16 places of every step.
struct Walk {
  double u, v;     ///< at the end
  double largest;  ///< |u| on the way
};

Walk walk(const Oscillator& o, double u, double v, const std::vector<double>& a) {
  constexpr int parts = 16;
  const OscillatorStep step = oscillator_step(o.theta / parts, o.xi);
  Walk at{u, v / parts, std::abs(u)};
  for (std::size_t n = 1; n < a.size(); ++n) {
    for (int k = 0; k < parts; ++k) {
      const double a0 = (a[n - 1] + (a[n] - a[n - 1]) * k / parts) / (parts * parts);
      const double a1 = (a[n - 1] + (a[n] - a[n - 1]) * (k + 1) / parts) / (parts * parts);
      const auto& [A, B] = step;
      const double next = A[0][0] * at.u + A[0][1] * at.v + B[0][0] * a0 + B[0][1] * a1;
      at.v = A[1][0] * at.u + A[1][1] * at.v + B[1][0] * a0 + B[1][1] * a1;
      at.u = next;
      at.largest = std::max(at.largest, std::abs(next));
    }
  }
  at.v *= parts;
  return at;
}

/// A record of one whole stretch: a hard case for either bound is a load in resonance.
std::vector<double> load(std::mt19937_64& random, double theta, int kind) {
  std::normal_distribution<double> normal;
  std::vector<double> a(stretch_size + 1);
  const double size = std::exp(3 * normal(random)), phase = 6 * normal(random);
  for (std::size_t n = 0; n < a.size(); ++n) {
    const auto t = static_cast<double>(n);
    a[n] = size * (kind == 0   ? normal(random)
                   : kind == 1 ? std::sin(theta * t + phase)
                   : kind == 2 ? (n % 2 == 0 ? 1 : -1)
                               : 1);
  }
  return a;
}

TEST(StretchBound, NoDisplacementExceedsIt) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int left_out = 0;
  for (const double theta : {1e-12, 1e-5, 0.003, 0.02, 0.06, 0.124}) {
    for (const double xi : {0.0, 0.02, 0.3, 0.95}) {
      const std::vector<Oscillator> one{make_oscillator(theta, xi)};
      const OscillatorBlock block(one);
      const StretchBound bound(block);
      for (int k = 0; k < 200; ++k) {
        const std::vector<double> a = load(random, theta, k % 4);
        const double scale = k % 3 == 0 ? 0 : std::exp(6 * normal(random));
        double u = scale * normal(random), v = scale * theta * normal(random);
        if (k % 3 == 1) {  // back at the start at the end: what lies between does not show
          const std::vector<double> none(a.size(), 0.0);
          v = (u - walk(one[0], u, 0, a).u) / walk(one[0], 0, 1, none).u;
        }
        const Walk found = walk(one[0], u, v, a);
        BlockState start, end;
        OscillatorBlock::Vector below, far_above;
        for (std::size_t b = 0; b < OscillatorBlock::vectors; ++b) {
          start.u[b] = all_octet(u);
          start.v[b] = all_octet(v);
          end.u[b] = all_octet(found.u);
          end.v[b] = all_octet(found.v);
          below[b] = all_octet(found.largest * (1 - 1e-12));
          far_above[b] = all_octet(2 * found.largest);
        }
        const Stretch stretch = stretches_of(a, 1)[0];
        EXPECT_TRUE(bound.may_exceed(start, end, stretch, below)) << theta << " " << xi << " " << k;
        left_out += bound.may_exceed(start, end, stretch, far_above) ? 0 : 1;
      }
    }
  }
  EXPECT_GT(left_out, 6 * 4 * 200 / 4);  // it does tell something
}

TEST(StretchJump, IsTheStepsOneAfterTheOther) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::vector<double> a(7 * stretch_size + 9);
  for (double& value : a) value = normal(random);
  std::vector<Oscillator> some;
  for (const double theta : {0.0, 1e-6, 1e-3, 0.03, 0.12, 0.9}) {
    for (const double xi : {0.0, 0.05, 0.9}) some.push_back(make_oscillator(theta, xi));
  }
  const OscillatorBlock block(some);
  const double h2 = 0.25;
  const std::vector<Stretch> stretches = stretches_of(a, h2);
  ASSERT_EQ(stretches.size(), 8);
  std::vector<BlockState> starts(stretches.size());
  StretchJump(block).find_starts(a, h2, stretches, starts);
  BlockState at{}, largest{};
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    for (std::size_t b = 0; b < OscillatorBlock::vectors; ++b) {
      for (std::size_t lane = 0; lane < octet_size; ++lane) {
        largest.u[b].set(lane, std::max(largest.u[b][lane], std::abs(at.u[b][lane])));
        largest.v[b].set(lane, std::max(largest.v[b][lane], std::abs(at.v[b][lane])));
        EXPECT_NEAR(starts[s].u[b][lane], at.u[b][lane], 1e-12 * largest.u[b][lane]);
        EXPECT_NEAR(starts[s].v[b][lane], at.v[b][lane], 1e-12 * largest.v[b][lane]);
      }
      for (std::size_t n = stretches[s].first + 1; n <= stretches[s].last; ++n) {
        block.step(b, all_octet(h2 * a[n - 1]), all_octet(h2 * a[n]), at.u[b], at.v[b]);
      }
    }
  }
}

}  // namespace stretch_bound_test
}  // namespace pounding::oscillator
