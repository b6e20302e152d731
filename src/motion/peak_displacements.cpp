#include "motion/peak_displacements.h"

#include <algorithm>
#include <cmath>

#include "common/octet.h"
#include "motion/oscillator_step.h"

namespace pounding {

namespace {

using namespace oscillator;

/// Samples of a stretch of the record.
constexpr std::size_t stretch_size = 128;

/// Below it an oscillator is at rest: subnormal numbers would only cost time.
constexpr double rest = 1e-250;

/// Oscillators whose steps are summed as series, side by side: their chains of sums hide each
/// other's latency.
struct OscillatorBlock {
  static constexpr std::size_t vectors = 3;
  static constexpr std::size_t size = vectors * octet_size;

  explicit OscillatorBlock(std::span<const Oscillator> some) : oscillators(some) {
    for (std::size_t i = 0; i < size; ++i) {
      const Oscillator& o = some[std::min(i, some.size() - 1)];  // the last one fills up
      const auto [state_part, load_part] = oscillator_step(o.theta, o.xi);
      const std::size_t b = i / octet_size, l = i % octet_size;
      for (std::size_t r = 0; r < 2; ++r) {
        for (std::size_t c = 0; c < 2; ++c) {
          A[r][c][b].set(l, state_part[r][c]);
          B[r][c][b].set(l, load_part[r][c]);
        }
      }
    }
  }

  /// (u, h u') of vector b at the end of a step from those at its start and h^2 times the
  /// acceleration at both ends.
  void step(std::size_t b, const Octet& before, const Octet& behind, Octet& u, Octet& v) const {
    Octet u1 = B[0][0][b] * before, v1 = B[1][0][b] * before;
    add_product(B[0][1][b], behind, u1);
    add_product(B[1][1][b], behind, v1);
    add_product(A[0][1][b], v, u1);
    add_product(A[1][1][b], v, v1);
    add_product(A[0][0][b], u, u1);
    add_product(A[1][0][b], u, v1);
    u = u1;
    v = v1;
  }

  std::span<const Oscillator> oscillators;
  Octet A[2][2][vectors], B[2][2][vectors];
};

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
struct StretchBound {
  explicit StretchBound(const Oscillator& o) {
    const double k = stiffness_of(o), d = damping_of(o);
    const double left = 1 - d - k / 8;
    of_load = left > 0.1 ? 1.001 / (8 * left) : 1e100;
    of_displacement = 1 + of_load * (2 * d + k);
  }
  double of_load, of_displacement;
};

/// Samples `first` to `last` of the record, both of which are looked at.
struct Stretch {
  std::size_t first, last;
  double load;  ///< largest |h^2 acceleration|
};

std::vector<Stretch> stretches_of(std::span<const double> acceleration, double h2) {
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first + 1 < acceleration.size(); first += stretch_size) {
    const std::size_t last = std::min(first + stretch_size, acceleration.size() - 1);
    double load = 0;
    for (std::size_t n = first; n <= last; ++n) {
      load = std::max(load, std::abs(h2 * acceleration[n]));
    }
    stretches.push_back({first, last, load});
  }
  return stretches;
}

/// The oscillators of a block at the start of a stretch, and the largest |u| at its samples.
struct Passage {
  Octet u[OscillatorBlock::vectors], v[OscillatorBlock::vectors], largest[OscillatorBlock::vectors];
};

/// Fills a passage for each stretch, and one more: the state after the last.
void pass(std::span<const double> acceleration, double h2, std::span<const Stretch> stretches,
          const OscillatorBlock& block, std::span<Passage> passages) {
  constexpr std::size_t vectors = OscillatorBlock::vectors;
  Octet u[vectors]{}, v[vectors]{}, largest[vectors];
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    const Stretch& stretch = stretches[s];
    for (std::size_t b = 0; b < vectors; ++b) {
      passages[s].u[b] = u[b];
      passages[s].v[b] = v[b];
      largest[b] = magnitude(u[b]);
    }
    Octet before = all_octet(h2 * acceleration[stretch.first]);
    for (std::size_t n = stretch.first + 1; n <= stretch.last; ++n) {
      const Octet behind = all_octet(h2 * acceleration[n]);
      for (std::size_t b = 0; b < vectors; ++b) {
        block.step(b, before, behind, u[b], v[b]);
        largest[b] = larger(largest[b], magnitude(u[b]));
      }
      before = behind;
    }
    for (std::size_t b = 0; b < vectors; ++b) {
      passages[s].largest[b] = largest[b];
      const Octet size = magnitude(u[b]) + magnitude(v[b]) + all_octet(stretch.load);
      u[b].lanes = size.lanes < rest ? Octet::Lanes8{} : u[b].lanes;
      v[b].lanes = size.lanes < rest ? Octet::Lanes8{} : v[b].lanes;
    }
  }
  for (std::size_t b = 0; b < vectors; ++b) {
    passages.back().u[b] = u[b];
    passages.back().v[b] = v[b];
  }
}

/// Raises the peak of one oscillator by the extrema inside the steps of a stretch.
class CloseLook {
 public:
  CloseLook(const OscillatorBlock& block, std::size_t b, std::size_t lane)
      : block_(block), b_(b), lane_(lane) {}

  void raise(double& peak, const Passage& start, std::span<const double> acceleration, double h2,
             const Stretch& stretch) const {
    Octet u = start.u[b_], v = start.v[b_];
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

  const Oscillator& oscillator() const { return block_.oscillators[b_ * octet_size + lane_]; }
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

/// Largest |u| of each oscillator of a block, of which the passages are known.
std::vector<double> peaks_of_block(std::span<const double> acceleration, double h2,
                                   std::span<const Stretch> stretches, const OscillatorBlock& block,
                                   std::span<const Passage> passages, AfterRecord after) {
  std::vector<double> peaks;
  for (std::size_t i = 0; i < block.oscillators.size(); ++i) {
    const std::size_t b = i / octet_size, l = i % octet_size;
    double peak = 0;
    for (std::size_t s = 0; s < stretches.size(); ++s) {
      peak = std::max(peak, passages[s].largest[b][l]);
    }
    const StretchBound bound(block.oscillators[i]);
    for (std::size_t s = 0; s < stretches.size(); ++s) {
      if (bound.of_displacement * passages[s].largest[b][l] + bound.of_load * stretches[s].load >
          peak) {
        CloseLook(block, b, l).raise(peak, passages[s], acceleration, h2, stretches[s]);
      }
    }
    if (after == AfterRecord::free_vibration) {
      const Passage& end = passages.back();
      peak = std::max(peak, free_vibration_peak(block.oscillators[i], end.u[b][l], end.v[b][l]));
    }
    peaks.push_back(peak);
  }
  return peaks;
}

/// Largest |u| of an oscillator whose step is taken in closed form.
double peak_displacement(std::span<const double> acceleration, double h2, const Oscillator& o,
                         AfterRecord after) {
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
  std::vector<Passage> passages(stretches.size() + 1);
  std::vector<double> peaks(oscillators.size(), 0.0);
  std::vector<Oscillator> slow;
  std::vector<std::size_t> place;
  const auto finish_block = [&] {
    const OscillatorBlock block(slow);
    pass(acceleration, h2, stretches, block, passages);
    const std::vector<double> found =
        peaks_of_block(acceleration, h2, stretches, block, passages, after);
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
