#include "stiffness/bricks/brick_kernel.h"

#include <type_traits>

namespace pounding::stiffness {
namespace {

/// One value of nodes i .. i + 3, and of i - 2 .. i + 1.
struct Window {
  Lanes nodes;
  Lanes seam;
};

struct Windows {
  Window v0, v1, v2;
};

/// Where four nodes stand in a run.
struct RunEnds {
  LaneMask inside;  ///< in the run at all
  Lanes weight;     ///< 1, at the first and the last node 1/2; 0 outside
  Lanes sign;       ///< 1 at the first node, -1 at the last
};

/// One value at four nodes and around them, as in brick_stencil.h; `end`: v_i at the first node of
/// the run, -v_i at the last.
struct Stencil {
  Lanes centre, sum, slope, end;
};

/// Three arrays of a half.
struct Arrays {
  double* v0;
  double* v1;
  double* v2;

  Arrays at(std::ptrdiff_t place) const { return {v0 + place, v1 + place, v2 + place}; }
};

/// Forces on four nodes.
struct Forces {
  Lanes f0, f1, f2;
};

POUNDING_INLINE void mask(const LaneMask& keep, Lanes& values) {
  values = (Lanes)((LaneMask)values & keep);
}

POUNDING_INLINE void find_ends(int first, int count, RunEnds& ends) {
  const LaneMask node = LaneMask{0, 1, 2, 3} + first;
  const LaneMask first_node = node == 0;
  const LaneMask last_node = node == count;
  ends.inside = node <= count;
  Lanes one{1, 1, 1, 1};
  Lanes minus_one = -one;
  ends.weight = one;
  Lanes half = 0.5 * one;
  mask(ends.inside, ends.weight);
  mask(first_node | last_node, half);
  ends.weight -= half;
  mask(first_node, one);
  mask(last_node, minus_one);
  ends.sign = one + minus_one;
}

POUNDING_INLINE void load_first(const double* values, const LaneMask& inside, Window& window) {
  load(values, window.nodes);
  mask(inside, window.nodes);
  window.seam = __builtin_shufflevector(Lanes{}, window.nodes, 2, 3, 4, 5);
}

POUNDING_INLINE void mask_last(const LaneMask& inside, Window& window) {
  mask(inside, window.nodes);
  mask(LaneMask{-1, -1, inside[0], inside[1]}, window.seam);
}

/// Moves the window on to the four nodes at `next`, or to nothing.
template <bool at_end>
POUNDING_INLINE void advance(const double* next, const RunEnds& ends, Window& window, Stencil& v) {
  Lanes nodes{};
  if (next != nullptr) load(next, nodes);
  const Lanes seam = __builtin_shufflevector(window.nodes, nodes, 2, 3, 4, 5);
  const Lanes left = __builtin_shufflevector(window.seam, window.nodes, 1, 4, 3, 6);
  const Lanes right = __builtin_shufflevector(window.nodes, seam, 1, 4, 3, 6);
  v.centre = window.nodes;
  v.sum = left + right;
  v.slope = right - left;
  if (at_end) {
    v.end = ends.sign * v.centre;
    v.centre = ends.weight * v.centre;
    mask(ends.inside, v.sum);
    mask(ends.inside, v.slope);
  }
  window.nodes = nodes;
  window.seam = seam;
}

POUNDING_INLINE void add(const AlongRun& k, const Stencil& v, Lanes& f) {
  add_product(k.centre, v.centre, f);
  add_product(k.side, v.sum, f);
}

POUNDING_INLINE void subtract(const AlongRun& k, const Stencil& v, Lanes& f) {
  subtract_product(k.centre, v.centre, f);
  subtract_product(k.side, v.sum, f);
}

POUNDING_INLINE void set(const AlongRun& k, const Stencil& v, Lanes& f) {
  f = k.centre * v.centre;
  add_product(k.side, v.sum, f);
}

/// The slope with which v_0 and v_2 act on each other.
template <bool plus, bool at_end>
POUNDING_INLINE void end_slope(const Stencil& v, Lanes& slope) {
  slope = v.slope;
  if (at_end) slope = plus ? slope + v.end : slope - v.end;
}

/// Forces on four nodes of a line itself, and on the next lines the part that is even and the one
/// that is odd along axis 1.
struct LineForces {
  Forces within, even, odd;
};

/// The part of a line's own forces that is odd: added for bricks before it, else subtracted.
template <Sides sides>
POUNDING_INLINE void add_skew(const Lanes& skew, Lanes& f) {
  f = sides == Sides::before ? f + skew : f - skew;
}

template <bool bending, Sides sides, bool at_end>
POUNDING_INLINE void act_0(const HalfStencil& k, const Stencil& v, LineForces& f) {
  const EvenBlock& within = sides == Sides::both ? k.within_both : k.within;
  Lanes slope;
  end_slope<bending, at_end>(v, slope);
  add(within.own_0, v, f.within.f0);
  subtract_product(within.slope, slope, f.within.f2);
  set(k.across_even.own_0, v, f.even.f0);
  f.even.f2 = k.across_even.slope * slope;
  f.odd.f1 = k.across_odd.slope * v.slope;
  if (at_end) add_product(k.across_odd.end, v.end, f.odd.f1);
  if (sides != Sides::both) {
    Lanes skew = k.skew.slope * v.slope;
    if (at_end) subtract_product(k.skew.end, v.end, skew);
    add_skew<sides>(-skew, f.within.f1);
  }
}

template <Sides sides, bool at_end>
POUNDING_INLINE void act_1(const HalfStencil& k, const Stencil& v, LineForces& f) {
  const EvenBlock& within = sides == Sides::both ? k.within_both : k.within;
  add(within.own_1, v, f.within.f1);
  set(k.across_even.own_1, v, f.even.f1);
  f.odd.f0 = k.across_odd.slope * v.slope;
  if (at_end) subtract_product(k.across_odd.end, v.end, f.odd.f0);
  set(k.across_odd.cross, v, f.odd.f2);
  if (sides != Sides::both) {
    Lanes skew = k.skew.slope * v.slope;
    if (at_end) add_product(k.skew.end, v.end, skew);
    add_skew<sides>(skew, f.within.f0);
    Lanes cross;
    set(k.skew.cross, v, cross);
    add_skew<sides>(cross, f.within.f2);
  }
}

template <bool bending, Sides sides, bool at_end>
POUNDING_INLINE void act_2(const HalfStencil& k, const Stencil& v, LineForces& f) {
  const EvenBlock& within = sides == Sides::both ? k.within_both : k.within;
  Lanes slope;
  end_slope<!bending, at_end>(v, slope);
  add(within.own_2, v, f.within.f2);
  add_product(within.slope, slope, f.within.f0);
  f.even.f2 = -f.even.f2;
  add(k.across_even.own_2, v, f.even.f2);
  add_product(k.across_even.slope, slope, f.even.f0);
  subtract(k.across_odd.cross, v, f.odd.f1);
  if (sides != Sides::both) {
    Lanes cross;
    set(k.skew.cross, v, cross);
    add_skew<sides>(cross, f.within.f1);
  }
}

template <bool first>
POUNDING_INLINE void pass_on(double* to, const Lanes& force) {
  Lanes total = force;
  if (!first) {
    load(to, total);
    total += force;
  }
  store(to, total);
}

/// Forces that four nodes of a line cause, one half; `more`: four nodes follow.
template <bool bending, Sides sides, bool first_behind, bool at_end>
POUNDING_INLINE void add_four(const HalfStencil& k, Windows& windows, const RunEnds& ends,
                              bool more, const Arrays& displacement, const Arrays& on_line,
                              const Arrays& on_before, const Arrays& on_behind) {
  LineForces f;
  load(on_line.v0, f.within.f0);
  load(on_line.v1, f.within.f1);
  load(on_line.v2, f.within.f2);
  Stencil v;
  advance<at_end>(more ? displacement.v0 + lane_count : nullptr, ends, windows.v0, v);
  act_0<bending, sides, at_end>(k, v, f);
  advance<at_end>(more ? displacement.v1 + lane_count : nullptr, ends, windows.v1, v);
  act_1<sides, at_end>(k, v, f);
  advance<at_end>(more ? displacement.v2 + lane_count : nullptr, ends, windows.v2, v);
  act_2<bending, sides, at_end>(k, v, f);
  store(on_line.v0, f.within.f0);
  store(on_line.v1, f.within.f1);
  store(on_line.v2, f.within.f2);
  if (sides != Sides::behind) {
    pass_on<false>(on_before.v0, f.even.f0 - f.odd.f0);
    pass_on<false>(on_before.v1, f.even.f1 - f.odd.f1);
    pass_on<false>(on_before.v2, f.even.f2 - f.odd.f2);
  }
  if (sides != Sides::before) {
    pass_on<first_behind>(on_behind.v0, f.even.f0 + f.odd.f0);
    pass_on<first_behind>(on_behind.v1, f.even.f1 + f.odd.f1);
    pass_on<first_behind>(on_behind.v2, f.even.f2 + f.odd.f2);
  }
}

/// Values of a half, or the forces on them.
template <bool bending>
POUNDING_INLINE Arrays half_of(const PairLine& line, std::ptrdiff_t stride, int array) {
  double* const in_plane = (bending ? line.difference : line.sum) + array * stride;
  double* const through = (bending ? line.sum : line.difference) + array * stride;
  return {in_plane, in_plane + stride, through + 2 * stride};
}

/// One half; `first`, `last`: ends of the run among its first and its last nodes.
template <bool bending, Sides sides, bool first_behind>
POUNDING_INLINE void add_half(const HalfStencil& k, const RunEnds& first, const RunEnds& last,
                              const PairLine& line, const PairLine& before, const PairLine& behind,
                              std::ptrdiff_t stride, int count) {
  const Arrays u = half_of<bending>(line, stride, 0);
  const Arrays on_line = half_of<bending>(line, stride, 3);
  const Arrays on_before = half_of<bending>(before, stride, 3);
  const Arrays on_behind = half_of<bending>(behind, stride, 3);
  Windows windows;
  load_first(u.v0, first.inside, windows.v0);
  load_first(u.v1, first.inside, windows.v1);
  load_first(u.v2, first.inside, windows.v2);
  const auto add_at = [&](int i, bool more, const RunEnds& ends, auto at_end)
      __attribute__((always_inline)) {
    add_four<bending, sides, first_behind, decltype(at_end)::value>(
        k, windows, ends, more, u.at(i), on_line.at(i), on_before.at(i), on_behind.at(i));
  };
  add_at(0, count >= lane_count, first, std::true_type{});
  int i = lane_count;
  for (; i + lane_count <= count; i += lane_count) add_at(i, true, first, std::false_type{});
  if (i <= count) {
    mask_last(last.inside, windows.v0);
    mask_last(last.inside, windows.v1);
    mask_last(last.inside, windows.v2);
    add_at(i, false, last, std::true_type{});
  }
}

template <Sides sides, bool first_behind>
void add_halves(const BrickStencil& stencil, const PairLine& line, const PairLine& before,
                const PairLine& behind, std::ptrdiff_t stride, int count) {
  RunEnds first, last;
  find_ends(0, count, first);
  find_ends(count / lane_count * lane_count, count, last);
  add_half<false, sides, first_behind>(stencil.membrane, first, last, line, before, behind, stride,
                                       count);
  add_half<true, sides, first_behind>(stencil.bending, first, last, line, before, behind, stride,
                                      count);
}

}  // namespace

void add_line_forces(const BrickStencil& stencil, Sides sides, bool first_behind,
                     const PairLine& line, const PairLine& before, const PairLine& behind,
                     std::ptrdiff_t stride, int count) {
  const auto add = [&](auto function) { function(stencil, line, before, behind, stride, count); };
  switch (sides) {
    case Sides::before:
      return add(add_halves<Sides::before, false>);
    case Sides::behind:
      return add(first_behind ? add_halves<Sides::behind, true> : add_halves<Sides::behind, false>);
    case Sides::both:
      return add(first_behind ? add_halves<Sides::both, true> : add_halves<Sides::both, false>);
  }
}

}  // namespace pounding::stiffness
