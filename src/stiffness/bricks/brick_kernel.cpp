#include "stiffness/bricks/brick_kernel.h"

#include <type_traits>

#include "common/wide_lanes.h"

namespace pounding::stiffness {
namespace {

/// One value of the nodes i, i + 1, ... of a vector, and of as many before or around them, from
/// which the nodes on both sides of each are taken with the fewest instructions.
struct Window {
  WideLanes nodes;
  WideLanes seam;
};

#ifdef __AVX512F__

/// The seam is the vector before.
POUNDING_INLINE WideLanes seam_between(const WideLanes& nodes, const WideLanes& /*next*/) {
  return nodes;
}
POUNDING_INLINE void find_sides(const Window& window, const Window& next, WideLanes& left,
                                WideLanes& right) {
  left = shifted_back(window.seam, window.nodes);
  right = shifted_on(window.nodes, next.nodes);
}
POUNDING_INLINE void mask_seam(const WideMask& /*inside*/, WideLanes& /*seam*/) {}

#else

/// The seam is the nodes i - 2 .. i + 1.
POUNDING_INLINE WideLanes seam_between(const WideLanes& nodes, const WideLanes& next) {
  return __builtin_shufflevector(nodes, next, 2, 3, 4, 5);
}
POUNDING_INLINE void find_sides(const Window& window, const Window& next, WideLanes& left,
                                WideLanes& right) {
  left = __builtin_shufflevector(window.seam, window.nodes, 1, 4, 3, 6);
  right = __builtin_shufflevector(window.nodes, next.seam, 1, 4, 3, 6);
}
POUNDING_INLINE void mask_seam(const WideMask& inside, WideLanes& seam) {
  mask_lanes(WideMask{-1, -1, inside[0], inside[1]}, seam);
}

#endif

struct Windows {
  Window v0, v1, v2;
};

/// Offsets of the nodes of a vector in a run.
struct RunEnds {
  WideMask inside;   ///< in the run at all
  WideLanes weight;  ///< 1, at the first and the last node 1/2; 0 outside
  WideLanes sign;    ///< 1 at the first node, -1 at the last
};

/// One value at the nodes of a vector and around them, as in brick_stencil.h; `end`: v_i at the
/// first node of the run, -v_i at the last.
struct Stencil {
  WideLanes centre, sum, slope, end;
};

/// Three arrays of a half.
struct Arrays {
  double* v0;
  double* v1;
  double* v2;

  Arrays at(std::ptrdiff_t offset) const { return {v0 + offset, v1 + offset, v2 + offset}; }
};

/// Forces on the nodes of a vector.
struct Forces {
  WideLanes f0, f1, f2;
};

POUNDING_INLINE void find_ends(int first, int count, RunEnds& ends) {
  const WideMask node = lane_numbers + first;
  const WideMask first_node = node == 0;
  const WideMask last_node = node == count;
  ends.inside = node <= count;
  WideLanes one = all_wide(1);
  WideLanes minus_one = -one;
  ends.weight = one;
  WideLanes half = 0.5 * one;
  mask_lanes(ends.inside, ends.weight);
  mask_lanes(first_node | last_node, half);
  ends.weight -= half;
  mask_lanes(first_node, one);
  mask_lanes(last_node, minus_one);
  ends.sign = one + minus_one;
}

POUNDING_INLINE void load_first(const double* values, const WideMask& inside, Window& window) {
  load(values, window.nodes);
  mask_lanes(inside, window.nodes);
  window.seam = seam_between(WideLanes{}, window.nodes);
}

POUNDING_INLINE void mask_last(const WideMask& inside, Window& window) {
  mask_lanes(inside, window.nodes);
  mask_seam(inside, window.seam);
}

/// Moves the window on to the nodes at `next`, or to nothing.
template <bool at_end>
POUNDING_INLINE void advance(const double* next, const RunEnds& ends, Window& window, Stencil& v) {
  Window after{};
  if (next != nullptr) load(next, after.nodes);
  after.seam = seam_between(window.nodes, after.nodes);
  WideLanes left, right;
  find_sides(window, after, left, right);
  v.centre = window.nodes;
  v.sum = left + right;
  v.slope = right - left;
  if (at_end) {
    v.end = ends.sign * v.centre;
    v.centre = ends.weight * v.centre;
    mask_lanes(ends.inside, v.sum);
    mask_lanes(ends.inside, v.slope);
  }
  window = after;
}

POUNDING_INLINE void add(const AlongRun& k, const Stencil& v, WideLanes& f) {
  add_product(widened(k.centre), v.centre, f);
  add_product(widened(k.side), v.sum, f);
}

POUNDING_INLINE void subtract(const AlongRun& k, const Stencil& v, WideLanes& f) {
  subtract_product(widened(k.centre), v.centre, f);
  subtract_product(widened(k.side), v.sum, f);
}

POUNDING_INLINE void set(const AlongRun& k, const Stencil& v, WideLanes& f) {
  f = widened(k.centre) * v.centre;
  add_product(widened(k.side), v.sum, f);
}

/// The slope with which v_0 and v_2 act on each other.
template <bool plus, bool at_end>
POUNDING_INLINE void end_slope(const Stencil& v, WideLanes& slope) {
  slope = v.slope;
  if (at_end) slope = plus ? slope + v.end : slope - v.end;
}

/// Forces on the nodes of a vector: those of a line itself, and on the next lines the part that is
/// even and the one that is odd along axis 1.
struct LineForces {
  Forces within, even, odd;
};

/// The part of a line's own forces that is odd: added for bricks before it, else subtracted.
template <Sides sides>
POUNDING_INLINE void add_skew(const WideLanes& skew, WideLanes& f) {
  f = sides == Sides::before ? f + skew : f - skew;
}

template <bool bending, Sides sides, bool at_end>
POUNDING_INLINE void act_0(const HalfStencil& k, const Stencil& v, LineForces& f) {
  const EvenBlock& within = sides == Sides::both ? k.within_both : k.within;
  WideLanes slope;
  end_slope<bending, at_end>(v, slope);
  add(within.own_0, v, f.within.f0);
  subtract_product(widened(within.slope), slope, f.within.f2);
  set(k.across_even.own_0, v, f.even.f0);
  f.even.f2 = widened(k.across_even.slope) * slope;
  f.odd.f1 = widened(k.across_odd.slope) * v.slope;
  if (at_end) add_product(widened(k.across_odd.end), v.end, f.odd.f1);
  if (sides != Sides::both) {
    WideLanes skew = widened(k.skew.slope) * v.slope;
    if (at_end) subtract_product(widened(k.skew.end), v.end, skew);
    add_skew<sides>(-skew, f.within.f1);
  }
}

template <Sides sides, bool at_end>
POUNDING_INLINE void act_1(const HalfStencil& k, const Stencil& v, LineForces& f) {
  const EvenBlock& within = sides == Sides::both ? k.within_both : k.within;
  add(within.own_1, v, f.within.f1);
  set(k.across_even.own_1, v, f.even.f1);
  f.odd.f0 = widened(k.across_odd.slope) * v.slope;
  if (at_end) subtract_product(widened(k.across_odd.end), v.end, f.odd.f0);
  set(k.across_odd.cross, v, f.odd.f2);
  if (sides != Sides::both) {
    WideLanes skew = widened(k.skew.slope) * v.slope;
    if (at_end) add_product(widened(k.skew.end), v.end, skew);
    add_skew<sides>(skew, f.within.f0);
    WideLanes cross;
    set(k.skew.cross, v, cross);
    add_skew<sides>(cross, f.within.f2);
  }
}

template <bool bending, Sides sides, bool at_end>
POUNDING_INLINE void act_2(const HalfStencil& k, const Stencil& v, LineForces& f) {
  const EvenBlock& within = sides == Sides::both ? k.within_both : k.within;
  WideLanes slope;
  end_slope<!bending, at_end>(v, slope);
  add(within.own_2, v, f.within.f2);
  add_product(widened(within.slope), slope, f.within.f0);
  f.even.f2 = -f.even.f2;
  add(k.across_even.own_2, v, f.even.f2);
  add_product(widened(k.across_even.slope), slope, f.even.f0);
  subtract(k.across_odd.cross, v, f.odd.f1);
  if (sides != Sides::both) {
    WideLanes cross;
    set(k.skew.cross, v, cross);
    add_skew<sides>(cross, f.within.f1);
  }
}

template <bool first>
POUNDING_INLINE void pass_on(double* to, const WideLanes& force) {
  WideLanes total = force;
  if (!first) {
    load(to, total);
    total += force;
  }
  store(to, total);
}

/// Forces that the nodes of a vector of a line cause, one half; `more`: another vector follows.
template <bool bending, Sides sides, bool first_behind, bool at_end>
POUNDING_INLINE void add_vector(const HalfStencil& k, Windows& windows, const RunEnds& ends,
                                bool more, const Arrays& displacement, const Arrays& on_line,
                                const Arrays& on_before, const Arrays& on_behind) {
  LineForces f;
  load(on_line.v0, f.within.f0);
  load(on_line.v1, f.within.f1);
  load(on_line.v2, f.within.f2);
  Stencil v;
  advance<at_end>(more ? displacement.v0 + wide_lane_count : nullptr, ends, windows.v0, v);
  act_0<bending, sides, at_end>(k, v, f);
  advance<at_end>(more ? displacement.v1 + wide_lane_count : nullptr, ends, windows.v1, v);
  act_1<sides, at_end>(k, v, f);
  advance<at_end>(more ? displacement.v2 + wide_lane_count : nullptr, ends, windows.v2, v);
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
    add_vector<bending, sides, first_behind, decltype(at_end)::value>(
        k, windows, ends, more, u.at(i), on_line.at(i), on_before.at(i), on_behind.at(i));
  };
  add_at(0, count >= wide_lane_count, first, std::true_type{});
  int i = wide_lane_count;
  for (; i + wide_lane_count <= count; i += wide_lane_count) {
    add_at(i, true, first, std::false_type{});
  }
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
  find_ends(count / wide_lane_count * wide_lane_count, count, last);
  add_half<false, sides, first_behind>(stencil.membrane, first, last, line, before, behind, stride,
                                       count);
  add_half<true, sides, first_behind>(stencil.bending, first, last, line, before, behind, stride,
                                      count);
}

}  // namespace

void split_pair(const double* near, const double* far, int count, std::ptrdiff_t stride,
                const PairLine& pair) {
  for (int c = 0; c < 3; ++c) {
    for (int p = 0; p < count; p += wide_lane_count) {
      WideLanes a, b;
      load(near + c * stride + p, a);
      load(far + c * stride + p, b);
      store(pair.sum + c * stride + p, b + a);
      store(pair.difference + c * stride + p, b - a);
    }
  }
}

void join_pair(const PairLine& pair, int count, std::ptrdiff_t stride, std::array<bool, 2> first,
               double* near, double* far) {
  const auto pass_on = [](bool set, WideLanes& force, double* to) {
    if (!set) {
      WideLanes before;
      load(to, before);
      force += before;
    }
    store(to, force);
  };
  for (int c = 3; c < 6; ++c) {
    for (int p = 0; p < count; p += wide_lane_count) {
      WideLanes sum, difference;
      load(pair.sum + c * stride + p, sum);
      load(pair.difference + c * stride + p, difference);
      WideLanes a = sum - difference;
      WideLanes b = sum + difference;
      pass_on(first[0], a, near + c * stride + p);
      pass_on(first[1], b, far + c * stride + p);
    }
  }
}

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
