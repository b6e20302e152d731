#pragma once

#include <array>
#include <span>
#include <vector>

#include <mpi.h>

#include "dynamics/state.h"
#include "system/linear_system.h"

namespace pounding {

/// One line of the ledger, all structures together [J].
struct EnergyLine {
  double time = 0;     ///< t_n; the energies stand half a step later
  double kinetic = 0;  ///< 1/2 v^T (M - dt/2 C) v
  double strain = 0;   ///< 1/2 u_{n+1}^T K u_n
  double damping_loss = 0;
  double contact_work = 0;
  double input_work = 0;   ///< of ground motion and gravity
  double device_work = 0;  ///< taken up by dashpots and tension-only bars
  double residual = 0;     ///< energy - initial energy + damping loss + device work - contact work
                           ///< - input work

  double energy() const { return kinetic + strain; }
};

/// Exact energy identity of the scheme, with vbar = (v_{n+1/2} + v_{n-1/2}) / 2:
///
///     E_{n+1/2} - E_{n-1/2} = -dt vbar^T C vbar + dt vbar^T (f_n - x_n) + 1/2 lambda^T L v_{n-1/2}
///     E_{n+1/2}             = 1/2 v^T (M - dt/2 C) v + 1/2 u_{n+1}^T K u_n
///
/// with x the force of dashpots and tension-only bars. Evaluated from q_n = K (u_n + beta
/// v_{n-1/2}) alone, since u_n = u_{n-1} + dt v_{n-1/2}:
///
///     K u_n       = (beta K u_{n-1} + dt q_n) / (beta + dt)
///     K v_{n-1/2} = (q_n - K u_{n-1}) / (beta + dt)
///
/// K v_{n+1/2} is known one step later, and so is the balance of step n. Sums are kept per rank and
/// added up only when a line is asked for. The balance starts at E_{1/2}.
class EnergyBalance {
 public:
  /// `shaken`: directions in which the ground moves.
  EnergyBalance(MPI_Comm comm, std::span<const LinearSystem> systems, std::array<bool, 3> shaken,
                double time_step);

  /// Called in step n when q_n is known and velocities are still v_{n-1/2}: closes step n-1. The
  /// energies, which only a line of the ledger shows, are evaluated on request.
  void close_previous_step(const State& state, bool with_energies);
  /// Called at the end of step n: its ground acceleration, and the contact work if this rank counts
  /// it (0 on the others).
  void add_step(const std::array<double, 3>& ground_acceleration, double contact_work);

  /// The ledger after the last closed step, which was closed with energies; `energies`, if not
  /// empty, receives the energy of each structure. Collective.
  EnergyLine line(std::span<double> energies) const;

  /// Largest |residual| over the largest term (energies, losses, works) of all lines so far.
  double relative_residual() const {
    return largest_term_ > 0 ? largest_residual_ / largest_term_ : 0;
  }
  std::int64_t closed_steps() const { return closed_steps_; }
  void note(const EnergyLine& line);

 private:
  /// Sum that does not lose what is added over millions of steps (Neumaier).
  struct Sum {
    double value = 0;
    double correction = 0;
    void add(double term);
    double total() const { return value + correction; }
  };

  struct Body {
    std::vector<double> stiffness_displacement;   ///< K u
    std::vector<double> stiffness_velocity;       ///< K v, of the velocities below
    std::vector<double> velocity;                 ///< v of the last closed step
    std::array<std::vector<double>, 3> momentum;  ///< M iota per direction
    std::array<double, 3> ground_momentum{};      ///< its product with `velocity`
    double kinetic = 0;
    double strain = 0;
    double initial = 0;
  };

  void evaluate_energies(const LinearSystem& system, const BodyState& state, Body& body) const;
  void close_body(const LinearSystem& system, const BodyState& state, Body& body);

  MPI_Comm comm_;
  std::span<const LinearSystem> systems_;
  std::array<bool, 3> shaken_;
  double time_step_;
  std::vector<Body> bodies_;
  std::array<double, 3> acceleration_{};
  double contact_step_ = 0;
  Sum damping_;
  Sum input_;
  Sum contact_;
  Sum device_;
  std::int64_t closed_steps_ = 0;
  double largest_term_ = 0;
  double largest_residual_ = 0;
};

}  // namespace pounding
