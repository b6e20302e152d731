#include "motion/stretch_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pounding::oscillator {
namespace {

constexpr double steps = stretch_size;
constexpr double eighth = steps * steps / 8;

/// More than rounding takes from a bound.
constexpr double above_round_off = 1 + 1e-9;

/// Integral of exp(-xi theta s) |sin(q theta s)| / (q theta) over a stretch, from above: half cycle
/// by half cycle, each with the damping at its start.
double integral_of_response(const Oscillator& o) {
  const double whole = steps * steps / 2;
  const double q = std::sqrt((1 - o.xi) * (1 + o.xi)), frequency = q * o.theta;
  if (frequency * steps < 1) return whole;
  const double decay = std::exp(-o.xi * std::numbers::pi / q);
  double sum = 0, part = 2 / (frequency * frequency);
  for (double angle = 0; angle < frequency * steps; angle += std::numbers::pi) {
    sum += part;
    part *= decay;
  }
  return std::min(whole, sum);
}

}  // namespace

StretchBound::StretchBound(const OscillatorBlock& block) {
  for (std::size_t i = 0; i < OscillatorBlock::size; ++i) {
    const Oscillator& o = block.of(i);
    const double q = std::sqrt((1 - o.xi) * (1 + o.xi));
    const double k = o.theta * o.theta;
    const auto put = [&](OscillatorBlock::Vector& to, double value) {
      to[i / octet_size].set(i % octet_size, value);
    };
    put(slope_, 1 / std::max(q * o.theta, 1e-100));
    put(share_, o.xi / q);
    put(impulse_, integral_of_response(o));
    put(of_amplitude_, eighth * (2 * o.xi + 1) * k);
    put(of_load_, eighth * 2 * o.xi * o.theta * steps);
    put(of_response_, eighth * k);
  }
}

bool StretchBound::may_exceed(const BlockState& start, const BlockState& end,
                              const Stretch& stretch, const OscillatorBlock::Vector& peak) const {
  const Octet load = all_octet(stretch.load), gained = all_octet(steps * stretch.velocity);
  const Octet chord = all_octet(std::min(eighth * stretch.load, steps / 2 * stretch.range));
  for (std::size_t b = 0; b < OscillatorBlock::vectors; ++b) {
    const Octet size = magnitude(start.u[b]);
    const Octet across = magnitude(slope_[b] * start.v[b] + share_[b] * start.u[b]);
    const Octet amplitude = size + across;  // of R, from above
    const Octet by_load = impulse_[b] * load;
    const Octet response = choose(by_load < gained, by_load, gained);
    const Octet near = larger(size, magnitude(end.u[b])) + chord + of_amplitude_[b] * amplitude +
                       of_load_[b] * load + of_response_[b] * response;
    const Octet left = peak[b] - response * all_octet(above_round_off);
    const Octet square = (size * size + across * across) * all_octet(above_round_off);
    const OctetMask closely = peak[b] < near * all_octet(above_round_off);
    const OctetMask widely = (left <= Octet{}) | (left * left < square);
    if (any(closely & widely)) return true;
  }
  return false;
}

}  // namespace pounding::oscillator
