#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <mpi.h>

#include "common/petsc.h"
#include "common/saved_state.h"
#include "dynamics/damping_filters.h"
#include "dynamics/energy_balance.h"
#include "dynamics/state.h"
#include "interactions/contact_problem.h"
#include "interactions/interaction.h"
#include "system/linear_system.h"

namespace pounding {

/// How fast a structure in generalised coordinates can close gaps, coordinate by coordinate: none
/// of them moves another, so each is bounded by its own energy. Per coordinate, with mass m,
/// damping c and stiffness k, and ubar the mean of two displacements one step apart,
///
///     a v^2 + k ubar^2,      a = m - dt/2 c - dt^2/4 k
///
/// falls but for the ground: |v| <= r = sqrt(v^2 + k ubar^2 / a), which rises per step by at most
/// dt m |iota| |a_g| / a (energy identity of dynamics/energy_balance.h). A gap then changes no
/// faster than sum_k |L_k| r_k. Uniform damping stiffens k in `a`, softens that of ubar, and adds
/// its branches, s a_i k (ubar - y_i)^2, see docs/reference/theory/damping.md. About a rest u_0
/// that it leaves alone, ubar - u_0 replaces ubar and the weight less k u_0 for the weight. Local.
class CoordinateRates {
 public:
  /// `rows`: L T over the owned coordinates, shape (gaps, coordinates). `ground_acceleration`:
  /// largest norm of it, gravity apart [m/s2]. The step must be stable, so that every `a` is
  /// positive. Collective over the system's communicator.
  CoordinateRates(const LinearSystem& system, std::vector<double> rows, double ground_acceleration,
                  double time_step);

  /// Bound of all gap rates at the last step made, before any contact [m/s].
  double rate(const StructureState& state);
  /// Largest rise of that bound per step [m/s].
  double growth() const { return growth_; }

 private:
  double largest(const std::vector<double>& speeds);

  double time_step_;
  std::vector<double> rest_;              ///< u_0 where uniform damping acts about it, or zero [m]
  std::vector<double> stiffness_over_a_;  ///< k / a, softened [1/s2]
  /// Stiffness of each branch over the coordinates, s a_i k / a [1/s2], and 1 / k [m/N].
  std::vector<std::vector<double>> branch_over_a_;
  Filters<double> filters_;
  std::vector<double> compliance_;
  std::vector<double> rows_;    ///< |L T|
  std::vector<double> speeds_;  ///< r
  std::vector<double> rates_;   ///< per gap
  double growth_ = 0;
};

/// When the interface has to be looked at again: no message is sent while no gap can close.
///
/// The discrete energy bounds every velocity, v^T A v <= 2 E with A = M - dt/2 C - dt^2/4 K, so
/// |L v| <= sqrt(L A^-1 L^T) sqrt(2 E) for each structure's part of a row. Without contact the
/// energy grows by the ground motion and gravity only: sqrt(2 E) rises at most by |M iota a| in the
/// norm of A^-1 per unit of time. Structures in generalised coordinates are bounded coordinate by
/// coordinate, far more closely. Bounds, not estimates: a contact is never missed.
class GapWatch {
 public:
  /// Bound of the velocities of one structure.
  struct Bound {
    /// Upper bound of the largest sqrt(L A^-1 L^T) [kg^-1/2]; infinite where nothing bounds it.
    double rate_norm = 0;
    /// Upper bound of |M iota| of each direction in the norm of A^-1 [kg^1/2].
    std::array<double, 3> force_norm{};
    /// L T in place of these two where the structure goes by coordinates, see CoordinateRates.
    std::vector<double> coordinate_rows;
    /// Norm of the weight less K u_0, where uniform damping acts about a rest: it takes the place
    /// of the weight [kg^1/2 m/s2].
    std::optional<double> rest_norm{};
  };

  /// Whether a structure is bounded coordinate by coordinate.
  static bool goes_by_coordinates(const LinearSystem& system) {
    return system.generalised && !system.has_extra_damping() && !system.links;
  }

  /// `peaks`: largest ground acceleration in each direction [m/s2]. Collective.
  GapWatch(std::span<const LinearSystem> systems, std::vector<Bound> bounds, const Vector3& peaks,
           double time_step);

  /// Energies per structure after step `step` [J], and by how much round-off may have made each
  /// one smaller than it is [J].
  void energies_known(std::int64_t step, std::span<const StructureEnergy> energies,
                      std::span<const double> round_off);

  /// Some structure is bounded by the sums that `measure` reads; the same on all ranks.
  bool measures() const { return measures_; }
  /// This rank's part of the bounds: add up over ranks before they go into `looked`.
  std::span<double> measure(std::span<const StructureState> structures);
  /// The smallest gap above the contact tolerance after a look at step `step` [m]; `touching` if
  /// an impulse acts in that step.
  void looked(std::int64_t step, double clearance, bool touching);

  bool due(std::int64_t step) const { return step >= next_look_; }
  /// A look at `step` that finds all open can lead to steps without a look. The same on all ranks
  /// that agree on the last touch.
  bool can_wait(std::int64_t step) const {
    return possible_ && step > 0 && (!needs_energy_ || energy_step_ > last_touch_);
  }
  /// The last step in which an impulse acted, as far as this rank knows.
  std::int64_t last_touch() const { return last_touch_; }
  void set_last_touch(std::int64_t step) { last_touch_ = step; }
  std::int64_t next_look() const { return next_look_; }
  /// Whether a look that finds nothing closed is worth `measure` and `looked`: one that was made
  /// for another reason, before it was due, leaves the last bound in force where to measure costs
  /// as much as to look.
  bool needs_look(std::int64_t step) const { return !measures_ || due(step); }

  void keep(const StateKeeper& state);

 private:
  /// Bound of the sum of all gap rates at a step after a look at step `look` [m/s].
  double rate_bound(std::int64_t look, std::int64_t step) const;

  double time_step_;
  std::vector<std::unique_ptr<CoordinateRates>> coordinates_;  ///< per structure; null: by energy
  std::vector<double> measured_;     ///< per structure, rate [m/s] and growth per step
  std::vector<double> rate_norm_;    ///< per structure
  std::vector<double> growth_;       ///< of sqrt(2 E) per step
  std::vector<double> root_energy_;  ///< sqrt(2 E) at energy_step_, round-off included
  std::int64_t energy_step_ = -1;
  std::int64_t last_touch_ = -1;
  std::int64_t next_look_ = 0;
  bool possible_ = true;
  bool measures_ = false;
  bool needs_energy_ = false;
};

/// Unilateral contact as an interaction, the three lines of CD-Lagrange that are its own:
///
///     A         = { i : g_i(u_n) <= g_tol }                                    detect_contact
///     0 <= lambda _|_ H lambda + L v_free >= 0   on A                          solve_impulse
///     v_{n+1/2} = v_free + M^-1 L^T lambda,      u_{n+1} = u_n + dt v_{n+1/2}  correct_velocity
///
/// They are events of -log_view under these names. The interface is looked at where a gap can close
/// (GapWatch) or a look is asked for. The last interaction of a step.
///
/// Ranks see their own rows. They agree on the smallest gap of all in looks after which steps
/// without a look may follow; after an impulse, until the energies are known again, they look in
/// every step and bring each other velocities whether they touch or not.
class UnilateralContact final : public interactions::Interaction {
 public:
  /// `problem` and `state`, that of the structures in the step, must outlive this object.
  UnilateralContact(MPI_Comm comm, interactions::ContactProblem& problem, GapWatch watch,
                    const State& state);
  ~UnilateralContact() override;

  void attach(std::span<interactions::SteppedStructure* const> structures) override;
  /// Detects contact.
  void begin(const interactions::Step& step) override;
  bool corrects() const override { return touching_; }
  std::int64_t next_action() const override {
    return problem_.member() ? watch_.next_look() : Interaction::next_action();
  }
  /// Solves for the impulses, and corrects.
  void push(const interactions::Step& step) override;
  void finish(const interactions::Step& step) override;
  void keep(const StateKeeper& state) override;

  /// See GapWatch. Collective over the members of the interface.
  void energies_known(std::int64_t step, std::span<const StructureEnergy> energies,
                      std::span<const double> round_off);
  /// This rank holds the gaps and impulses of the current step.
  bool interface_known() const { return interface_known_; }
  bool touching() const { return touching_; }  ///< rows that this rank holds
  /// Some rank of the interface may be touching; the same on all of them.
  bool may_touch() const { return may_touch_; }
  /// Steps so far in which the interface was looked at; members of the interface only.
  std::int64_t looks() const { return looks_; }

 private:
  void detect_contact(const interactions::Step& step);
  /// Finds whether some rank may touch. Returns the smallest gap [m] and whether there is an
  /// impulse: of all ranks where steps without a look may follow, else of this one.
  std::pair<double, bool> agree(std::int64_t step);
  void agree_on_last_touch();
  /// This rank touches, or brings others that may touch its velocities.
  bool takes_part() const { return touching_ || (may_touch_ && problem_.exchanges()); }
  /// Brings the state to the bound of the gap rates.
  void measure(const interactions::Step& step);
  void solve_impulse(const interactions::Step& step);
  void correct_velocity(const interactions::Step& step);

  struct Events {
    LogEvent detect_contact{"detect_contact"};
    LogEvent solve_impulse{"solve_impulse"};
    LogEvent correct_velocity{"correct_velocity"};
  };

  interactions::ContactProblem& problem_;
  GapWatch watch_;
  const State& state_;
  bool is_root_;  ///< of the interface
  /// Per structure, the dofs that move its interface: before the step, and their velocity in it.
  std::vector<interactions::Before> before_;
  std::vector<std::vector<double>> velocity_;
  Events events_;
  bool interface_known_ = false;
  bool touching_ = false;
  bool may_touch_ = false;
  std::int64_t looks_ = 0;
};

}  // namespace pounding
