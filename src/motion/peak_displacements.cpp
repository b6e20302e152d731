#include "motion/peak_displacements.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/memory.h"
#include "motion/oscillator_block.h"
#include "motion/oscillator_rest.h"
#include "motion/record_stretch.h"
#include "motion/stretch_bound.h"
#include "motion/stretch_jump.h"

namespace pounding {

namespace {

using namespace oscillator;

/// Angle that an oscillator may turn in a stretch so that a bound from its ends is of use.
constexpr double widest_turn = 8;

double stiffness_of(const Oscillator& o) {
  return o.theta * o.theta;
}
double damping_of(const Oscillator& o) {
  return 2 * o.xi * o.theta;
}

/// Bound of the displacement between samples: with U and a the largest |u| and |h^2 acceleration|
/// at the samples of a stretch it is of_displacement U + of_load a. An extremum lies within half a
/// step of a sample, so |u| <= U + W / 8, W the largest |h^2 u''| within the steps; and
/// |h u'| <= 2 U + W, as it is |u1 - u0| somewhere in the step; the equation of motion bounds W
/// by a + d (2 U + W) + k (U + W / 8). Where damping is too large for that nothing is left out.
struct BetweenSamples {
  explicit BetweenSamples(const Oscillator& o) {
    const double k = stiffness_of(o), d = damping_of(o);
    const double left = 1 - d - k / 8;
    of_load = left > 0.1 ? 1.001 / (8 * left) : 1e100;
    of_displacement = 1 + of_load * (2 * d + k);
  }
  double of_load, of_displacement;
};

/// The stretches of the record that a block is stepped through, and how far it comes in each.
class Passages {
 public:
  struct Passage {
    /// Leaves the largest ones open.
    Passage(const Stretch& through, const BlockState& from) : stretch(&through), start(from) {}

    const Stretch* stretch;
    BlockState start;
    OscillatorBlock::Vector largest;  ///< |u| at the samples
  };

  /// The arguments must outlive this object.
  Passages(std::span<const double> acceleration, double h2, std::span<const Stretch> stretches)
      : acceleration_(acceleration), h2_(h2), stretches_(stretches), starts_(stretches.size()) {
    passages_.reserve(stretches.size());
  }

  /// Steps a block through every stretch in which some oscillator may come further than at the
  /// starts of all others and in the stretches before.
  void go_where_it_may_peak(const OscillatorBlock& block);
  /// Steps a block through all of them.
  void go_everywhere(const OscillatorBlock& block);

  std::span<const Passage> passages() const { return passages_; }
  /// After the record.
  const BlockState& end() const { return end_; }

 private:
  /// Goes through a stretch and returns the state at its end.
  BlockState pass(const OscillatorBlock& block, const Stretch& stretch, const BlockState& start);

  std::span<const double> acceleration_;
  double h2_;
  std::span<const Stretch> stretches_;
  std::vector<BlockState, LargePageAllocator<BlockState>> starts_;
  std::vector<Passage, LargePageAllocator<Passage>> passages_;
  BlockState end_{};
};

void Passages::go_everywhere(const OscillatorBlock& block) {
  passages_.clear();
  end_ = {};
  for (const Stretch& stretch : stretches_) end_ = pass(block, stretch, BlockState(end_));
}

void Passages::go_where_it_may_peak(const OscillatorBlock& block) {
  passages_.clear();
  end_ = {};
  StretchJump(block).find_starts(acceleration_, h2_, stretches_, starts_);
  OscillatorBlock::Vector peak{};
  for (const BlockState& start : starts_) {
    for (std::size_t b = 0; b < OscillatorBlock::vectors; ++b) {
      peak[b] = larger(peak[b], magnitude(start.u[b]));
    }
  }
  const StretchBound bound(block);
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const bool last = s + 1 == stretches_.size();
    if (!last && !bound.may_exceed(starts_[s], starts_[s + 1], stretches_[s], peak)) continue;
    end_ = pass(block, stretches_[s], starts_[s]);
    for (std::size_t b = 0; b < OscillatorBlock::vectors; ++b) {
      peak[b] = larger(peak[b], passages_.back().largest[b]);
    }
  }
}

BlockState Passages::pass(const OscillatorBlock& block, const Stretch& stretch,
                          const BlockState& start) {
  constexpr std::size_t vectors = OscillatorBlock::vectors;
  BlockState at = start;
  OscillatorBlock::Vector largest;
  for (std::size_t b = 0; b < vectors; ++b) largest[b] = magnitude(at.u[b]);
  Octet before = all_octet(h2_ * acceleration_[stretch.first]);
  for (std::size_t n = stretch.first + 1; n <= stretch.last; ++n) {
    const Octet behind = all_octet(h2_ * acceleration_[n]);
    for (std::size_t b = 0; b < vectors; ++b) {
      block.step(b, before, behind, at.u[b], at.v[b]);
      largest[b] = larger(largest[b], magnitude(at.u[b]));
    }
    before = behind;
  }
  for (std::size_t b = 0; b < vectors; ++b) come_to_rest(stretch.load, at.u[b], at.v[b]);
  Passage& passage = passages_.emplace_back(stretch, start);
  std::copy(std::begin(largest), std::end(largest), std::begin(passage.largest));
  return at;
}

/// Raises the peak of one oscillator by the extrema inside the steps of a stretch.
class CloseLook {
 public:
  CloseLook(const OscillatorBlock& block, std::size_t b, std::size_t lane)
      : block_(block), b_(b), lane_(lane) {}

  void raise(double& peak, const Passages::Passage& passage, std::span<const double> acceleration,
             double h2) const {
    const Stretch& stretch = *passage.stretch;
    Octet u = passage.start.u[b_], v = passage.start.v[b_];
    double a = h2 * acceleration[stretch.first];
    for (std::size_t n = stretch.first + 1; n <= stretch.last; ++n) {
      const double u0 = u[lane_], v0 = v[lane_], a1 = h2 * acceleration[n];
      block_.step(b_, all_octet(a), all_octet(a1), u, v);
      if (may_exceed(peak, {u0, v0, a}, {u[lane_], v[lane_], a1})) {
        peak = std::max(peak, interior_peak(StepSeries(oscillator(), u0, v0, a, a1)));
      }
      a = a1;
    }
  }

 private:
  struct End {
    double u, v, a;
  };

  const Oscillator& oscillator() const { return block_.of(b_ * octet_size + lane_); }
  double curvature(const End& at) const {  // h^2 u''
    return -(at.a + damping_of(oscillator()) * at.v + stiffness_of(oscillator()) * at.u);
  }

  /// Whether u may turn within a step, and beyond the peak there.
  bool may_exceed(double peak, const End& from, const End& to) const {
    const double w0 = curvature(from), w1 = curvature(to);
    // An extremum lies within half a step of an end, so it cannot exceed this.
    const double bound = std::max(std::abs(from.u), std::abs(to.u)) +
                         (std::abs(from.v) + std::abs(w0) + (std::abs(to.v) + std::abs(w1)));
    return bound > peak && (from.v * to.v <= 0 || (from.v * w0 < 0 && to.v * w1 > 0));
  }

  const OscillatorBlock& block_;
  std::size_t b_, lane_;
};

/// Largest |u| of each oscillator of a block.
std::vector<double> peaks_of_block(std::span<const double> acceleration, double h2,
                                   Passages& passages, const OscillatorBlock& block,
                                   AfterRecord after) {
  double turn = 0;
  for (const Oscillator& o : block.oscillators) {
    turn = std::max(turn, o.theta * static_cast<double>(stretch_size));
  }
  turn < widest_turn ? passages.go_where_it_may_peak(block) : passages.go_everywhere(block);
  std::vector<double> peaks;
  for (std::size_t i = 0; i < block.oscillators.size(); ++i) {
    const std::size_t b = i / octet_size, l = i % octet_size;
    double peak = 0;
    for (const Passages::Passage& one : passages.passages()) {
      peak = std::max(peak, one.largest[b][l]);
    }
    const BetweenSamples bound(block.oscillators[i]);
    for (const Passages::Passage& one : passages.passages()) {
      if (bound.of_displacement * one.largest[b][l] + bound.of_load * one.stretch->load > peak) {
        CloseLook(block, b, l).raise(peak, one, acceleration, h2);
      }
    }
    if (after == AfterRecord::free_vibration) {
      const BlockState& end = passages.end();
      peak = std::max(peak, free_vibration_peak(block.oscillators[i], end.u[b][l], end.v[b][l]));
    }
    peaks.push_back(peak);
  }
  return peaks;
}

/// Angle per step beyond which an oscillator follows the load and its own swing, which the first
/// sample sets off, but for 4 / theta of it: nobody waits for the look at every turn.
constexpr double follows_load = 1e5;

/// Largest |u| of an oscillator that turns that fast.
double followed_load(std::span<const double> acceleration, double h2, const Oscillator& o) {
  const double decay = o.xi < 1 ? o.xi / std::sqrt(1 - o.xi * o.xi) : 1e300;
  double swing = h2 * std::abs(acceleration[0]) * std::exp(-std::numbers::pi * decay);
  double load = 0;
  for (const double sample : acceleration) {
    load = std::max(load, h2 * std::abs(sample) + swing);
    swing *= std::exp(-o.xi * o.theta);
  }
  return (1 + 4 / o.theta) * load / stiffness_of(o);
}

/// Largest |u| of an oscillator whose step is taken in closed form.
double peak_displacement(std::span<const double> acceleration, double h2, const Oscillator& o,
                         AfterRecord after) {
  if (o.theta > follows_load) return followed_load(acceleration, h2, o);
  const auto [A, B] = oscillator_step(o.theta, o.xi);
  double u = 0, v = 0, a = h2 * acceleration[0], peak = 0;
  for (std::size_t n = 1; n < acceleration.size(); ++n) {
    const double a1 = h2 * acceleration[n];
    const double u1 = A[0][0] * u + (A[0][1] * v + (B[0][0] * a + B[0][1] * a1));
    const double v1 = A[1][0] * u + (A[1][1] * v + (B[1][0] * a + B[1][1] * a1));
    peak = std::max(peak, std::abs(u1));
    const StepClosedForm step(o, u, v, a, a1);
    if (step.bound(0) > peak) peak = interior_peak(step, peak);
    u = u1, v = v1, a = a1;
  }
  if (after == AfterRecord::ignored) return peak;
  return std::max(peak, free_vibration_peak(o, u, v));
}

}  // namespace

std::vector<double> peak_displacements(std::span<const double> acceleration, double time_step,
                                       std::span<const Oscillator> oscillators, AfterRecord after) {
  const double h2 = time_step * time_step;
  const std::vector<Stretch> stretches = stretches_of(acceleration, h2);
  Passages passages(acceleration, h2, stretches);
  std::vector<double> peaks(oscillators.size(), 0.0);
  std::vector<Oscillator> slow;
  std::vector<std::size_t> place;
  const auto finish_block = [&] {
    const std::vector<double> found =
        peaks_of_block(acceleration, h2, passages, OscillatorBlock(slow), after);
    for (std::size_t i = 0; i < found.size(); ++i) peaks[place[i]] = found[i];
    slow.clear();
    place.clear();
  };
  for (std::size_t i = 0; i < oscillators.size(); ++i) {
    if (oscillators[i].theta >= series_limit) {
      peaks[i] = peak_displacement(acceleration, h2, oscillators[i], after);
      continue;
    }
    slow.push_back(oscillators[i]);
    place.push_back(i);
    if (slow.size() == OscillatorBlock::size) finish_block();
  }
  if (!slow.empty()) finish_block();
  return peaks;
}

}  // namespace pounding
