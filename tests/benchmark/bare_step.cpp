#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "benchmark/timed_step.h"
#include "common/parallel.h"
#include "mesh/element_properties.h"
#include "stiffness/bricks/brick_stencil.h"

namespace pounding::measuring {
namespace {

/// Displacement-like values of a pair of nodes, far above near: of the half that membranes move in
/// s_0, s_1, d_2 with s = far + near and d = far - near, of that in bending d_0, d_1, s_2.
constexpr int fields = 6;

/// Side of a row on which bricks lie.
enum class Bricks { before, behind, both };

/// One half's coefficients as plain numbers, see brick_stencil.h. `sign`: 1 in bending, -1 in
/// membranes, of the end in the slope of value 0; the other way round in that of value 2.
struct Half {
  struct Even {
    double centre[3], side[3], slope;
  };
  struct Odd {
    double centre, side, slope, end;
  };
  Even within, within_both, across_even;
  Odd skew, across_odd;
  double sign;
};

Half::Even plain(const stiffness::EvenBlock& k) {
  return {{k.own_0.centre[0], k.own_1.centre[0], k.own_2.centre[0]},
          {k.own_0.side[0], k.own_1.side[0], k.own_2.side[0]},
          k.slope[0]};
}

Half::Odd plain(const stiffness::OddBlock& k) {
  return {k.cross.centre[0], k.cross.side[0], k.slope[0], k.end[0]};
}

Half plain(const stiffness::HalfStencil& k, double sign) {
  return {plain(k.within), plain(k.within_both), plain(k.across_even),
          plain(k.skew),   plain(k.across_odd),  sign};
}

#define POUNDING_INLINE inline __attribute__((always_inline))

/// As many nodes at once as the widest vectors of the machine take.
constexpr std::ptrdiff_t wide = 8;
using Wide = double __attribute__((vector_size(wide * sizeof(double))));

template <class Number>
POUNDING_INLINE Number read(const double* from) {
  Number value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// Three values at nodes of a row and beside them, in vectors or alone; `end`: of the last node the
/// opposite of its value, else unused.
template <class Number>
struct Values {
  Number centre[3], sum[3], slope[3], end[3];
};

/// Values at place `i` of three fields of a row, plus `sign` times those of another.
template <int sign, class Number>
POUNDING_INLINE void find_values(const double* row, const double* other, std::ptrdiff_t stride,
                                 std::ptrdiff_t i, Values<Number>& v) {
  constexpr bool last = std::is_same_v<Number, double>;
  const auto at = [&](std::ptrdiff_t place) {
    Number value = read<Number>(row + place);
    if constexpr (sign > 0) value += read<Number>(other + place);
    if constexpr (sign < 0) value -= read<Number>(other + place);
    return value;
  };
  for (int c = 0; c < 3; ++c) {
    const std::ptrdiff_t place = c * stride + i;
    const Number left = at(place - 1);
    const Number middle = at(place);
    if constexpr (last) {
      v.centre[c] = 0.5 * middle;
      v.sum[c] = left;
      v.slope[c] = -left;
      v.end[c] = -middle;
    } else {
      const Number right = at(place + 1);
      v.centre[c] = middle;
      v.sum[c] = left + right;
      v.slope[c] = right - left;
      v.end[c] = Number{};
    }
  }
}

template <class Number>
POUNDING_INLINE void add_own(const Half::Even& k, const Values<Number>& v, int c, Number& f) {
  f += k.centre[c] * v.centre[c];
  f += k.side[c] * v.sum[c];
}

template <class Number>
POUNDING_INLINE void add_even(const Half::Even& k, double sign, const Values<Number>& v,
                              Number* f) {
  for (int c = 0; c < 3; ++c) add_own(k, v, c, f[c]);
  f[0] += k.slope * v.slope[2];
  f[2] -= k.slope * v.slope[0];
  if constexpr (std::is_same_v<Number, double>) {
    f[0] -= k.slope * sign * v.end[2];
    f[2] -= k.slope * sign * v.end[0];
  }
}

/// Adds `sign` times the force of value `c` across axis 1.
template <class Number>
POUNDING_INLINE void add_cross(const Half::Odd& k, double sign, const Values<Number>& v, int c,
                               Number& f) {
  f += sign * k.centre * v.centre[c];
  f += sign * k.side * v.sum[c];
}

template <class Number>
POUNDING_INLINE void add_odd(const Half::Odd& k, const Values<Number>& v, Number* f) {
  f[0] += k.slope * v.slope[1] - k.end * v.end[1];
  f[1] += k.slope * v.slope[0] + k.end * v.end[0];
  add_cross(k, -1, v, 2, f[1]);
  add_cross(k, 1, v, 1, f[2]);
}

template <class Number>
POUNDING_INLINE void add_skew(const Half::Odd& k, double sign, const Values<Number>& v, Number* f) {
  f[0] += sign * (k.slope * v.slope[1] + k.end * v.end[1]);
  f[1] -= sign * (k.slope * v.slope[0] - k.end * v.end[0]);
  add_cross(k, sign, v, 2, f[1]);
  add_cross(k, sign, v, 1, f[2]);
}

/// What a step does to a velocity: v := decay v - push f - ground, f and ground of every field.
struct Push {
  double decay, push, ground[fields];
};

/// Rows of w, and the velocities of the one in the middle.
struct Rows {
  const double* before;
  const double* line;
  const double* behind;
  double* velocity;
};

/// Velocities at place `i` of a row, one half.
template <Bricks bricks, class Number>
POUNDING_INLINE void update_half(const Half& k, const Rows& rows, std::ptrdiff_t stride,
                                 std::ptrdiff_t i, const Push& by, const double* ground) {
  Values<Number> v;
  Number f[3] = {};
  find_values<0>(rows.line, rows.line, stride, i, v);
  add_even(bricks == Bricks::both ? k.within_both : k.within, k.sign, v, f);
  if constexpr (bricks != Bricks::both) {
    add_skew(k.skew, bricks == Bricks::before ? 1.0 : -1.0, v, f);
  }
  find_values<1>(rows.before, rows.behind, stride, i, v);
  add_even(k.across_even, k.sign, v, f);
  find_values<-1>(rows.before, rows.behind, stride, i, v);
  add_odd(k.across_odd, v, f);
  for (int c = 0; c < 3; ++c) {
    double* const place = rows.velocity + c * stride + i;
    const Number moved = by.decay * read<Number>(place) - by.push * f[c] - ground[c];
    std::memcpy(place, &moved, sizeof moved);
  }
}

/// Velocities of a row; the last node has half the mass. Places behind it are of no use.
template <Bricks bricks>
void update_row(const Half* halves, const Rows& rows, std::ptrdiff_t stride, std::ptrdiff_t count,
                const Push& by) {
  Push at_end = by;
  at_end.push *= 2;
  for (int half = 0; half < 2; ++half) {
    const std::ptrdiff_t first = 3 * half * stride;
    const Rows of_half{rows.before + first, rows.line + first, rows.behind + first,
                       rows.velocity + first};
    const Half k = halves[half];
    double last[3];
    for (int c = 0; c < 3; ++c) last[c] = of_half.velocity[c * stride + count];
    for (std::ptrdiff_t i = 1; i < count; i += wide) {
      update_half<bricks, Wide>(k, of_half, stride, i, by, by.ground + 3 * half);
    }
    for (int c = 0; c < 3; ++c) {
      double* const row = of_half.velocity + c * stride;
      row[count] = last[c];
      std::fill(row + count + 1, row + stride, 0.0);
    }
    update_half<bricks, double>(k, of_half, stride, count, at_end, by.ground + 3 * half);
  }
}

/// The step of a slab of bricks, one through its thickness, by a kernel that knows nothing else:
/// regular arrays of sums and differences of the nodes that face each other, no list of elements or
/// dofs, no ledger, no contact. Rows across x are shared out among the ranks.
class BareStep final : public TimedStep {
 public:
  BareStep(const SteppedModel& model, const ModelRequest& request)
      : comm_(model.comm),
        motion_(*model.motion),
        time_step_(model.time_step),
        damping_(model.systems.at(0).damping),
        count_(request.cells[0]),
        stride_((count_ + 1 + 2 * wide) / wide * wide),
        row_size_(fields * stride_) {
    if (request.cells[2] != 1 || request.skew || count_ < 1) {
      throw std::invalid_argument("a bare step needs a slab of one layer of boxes");
    }
    const ElementProperties properties = element_properties(model.structures.at(0).regions.at(0));
    const stiffness::BrickStencil stencil = stiffness::brick_stencil(
        stiffness::split_brick(ElementType::hex8, properties, cell_size).value());
    halves_[0] = plain(stencil.membrane, -1);
    halves_[1] = plain(stencil.bending, 1);
    corner_mass_ = properties.density * cell_size[0] * cell_size[1] * cell_size[2] / 8;
    const int rows = request.cells[1] + 1;
    const int rank = rank_of(comm_), ranks = size_of(comm_);
    const int begin = rows * rank / ranks, end = rows * (rank + 1) / ranks;
    rows_ = end - begin;
    if (rows < 2 * ranks) throw std::invalid_argument("too few rows for a bare step");
    before_ = rank == 0 ? MPI_PROC_NULL : rank - 1;
    behind_ = rank == ranks - 1 ? MPI_PROC_NULL : rank + 1;
    displacement_.assign(static_cast<std::size_t>(rows_ * row_size_), 0.0);
    velocity_ = displacement_;
    for (auto* row :
         {&ring_[0], &ring_[1], &ring_[2], &first_, &last_, &halo_before_, &halo_behind_}) {
      row->assign(static_cast<std::size_t>(row_size_), 0.0);
    }
  }

  void run(long steps) override {
    for (long i = 0; i < steps; ++i, ++step_) step();
  }

  double displacement_square() const override {
    double sum = 0;
    for (const double u : displacement_) sum += u * u;
    return sum / 2;  // far^2 + near^2 = (s^2 + d^2) / 2
  }

 private:
  /// Moves a row on and leaves w = u + beta v there.
  void prepare(int row, double duration, std::vector<double>& argument) {
    double* const u = &displacement_[static_cast<std::size_t>(row * row_size_)];
    const double* const v = &velocity_[static_cast<std::size_t>(row * row_size_)];
    double* const w = argument.data();
    const double beta = damping_.beta;
#pragma GCC ivdep
    for (std::ptrdiff_t i = 0; i < row_size_; ++i) {
      u[i] += duration * v[i];
      w[i] = u[i] + beta * v[i];
    }
  }

  void exchange() {
    const auto count = static_cast<int>(row_size_);
    MPI_Sendrecv(first_.data(), count, MPI_DOUBLE, before_, 0, halo_behind_.data(), count,
                 MPI_DOUBLE, behind_, 0, comm_, MPI_STATUS_IGNORE);
    MPI_Sendrecv(last_.data(), count, MPI_DOUBLE, behind_, 1, halo_before_.data(), count,
                 MPI_DOUBLE, before_, 1, comm_, MPI_STATUS_IGNORE);
  }

  /// w of a row of this rank or of the one before or behind; of zeros beyond the slab.
  const double* argument(int row) const {
    if (row < 0) return halo_before_.data();
    if (row == rows_) return halo_behind_.data();
    if (row == 0) return first_.data();
    if (row == rows_ - 1) return last_.data();
    return ring_[row % 3].data();
  }

  void step() {
    const double moving = step_ > 0 ? time_step_ : 0;
    const double pushing = step_ > 0 ? time_step_ : time_step_ / 2;
    prepare(0, moving, first_);
    prepare(rows_ - 1, moving, last_);
    if (size_of(comm_) > 1) exchange();
    Vector3 acceleration{};
    motion_.evaluate(static_cast<double>(step_) * time_step_, acceleration);
    Push by{};
    by.decay = 1 - pushing * damping_.alpha;
    for (int c : {0, 1}) by.ground[c] = 2 * pushing * acceleration[static_cast<std::size_t>(c)];
    by.ground[5] = 2 * pushing * acceleration[2];
    for (int row = 0; row < rows_; ++row) {
      if (row + 1 < rows_ - 1) prepare(row + 1, moving, ring_[(row + 1) % 3]);
      const bool at_first = row == 0 && before_ == MPI_PROC_NULL;
      const bool at_last = row == rows_ - 1 && behind_ == MPI_PROC_NULL;
      // A node inside has four bricks; the force on a sum is twice the half's.
      by.push = 2 * pushing / (corner_mass_ * (at_first || at_last ? 2 : 4));
      const auto update = at_first  ? update_row<Bricks::behind>
                          : at_last ? update_row<Bricks::before>
                                    : update_row<Bricks::both>;
      update(halves_,
             {argument(row - 1), argument(row), argument(row + 1),
              &velocity_[static_cast<std::size_t>(row * row_size_)]},
             stride_, count_, by);
    }
  }

  MPI_Comm comm_;
  const GroundMotion& motion_;
  double time_step_;
  Rayleigh damping_;
  std::ptrdiff_t count_;     ///< bricks along x: nodes beside the clamped one
  std::ptrdiff_t stride_;    ///< from a field of a row to the next
  std::ptrdiff_t row_size_;  ///< of all fields
  int rows_ = 0;             ///< of this rank
  int before_ = MPI_PROC_NULL, behind_ = MPI_PROC_NULL;  ///< ranks that have the next rows
  Half halves_[2];
  double corner_mass_ = 0;  ///< of a brick [kg]
  std::vector<double> displacement_, velocity_;
  std::vector<double> ring_[3], first_, last_, halo_before_, halo_behind_;  ///< rows of w
  long step_ = 0;
};

}  // namespace

std::unique_ptr<TimedStep> make_bare_step(const SteppedModel& model, const ModelRequest& request) {
  return std::make_unique<BareStep>(model, request);
}

}  // namespace pounding::measuring
