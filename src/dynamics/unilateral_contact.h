#pragma once

#include <cstdint>
#include <vector>

#include <mpi.h>

#include "common/log_event.h"
#include "dynamics/gap_watch.h"
#include "dynamics/state.h"
#include "interactions/contact_problem.h"
#include "interactions/interaction.h"

namespace pounding {

/// Unilateral contact as an interaction, the three lines of CD-Lagrange that are its own:
///
///     A         = { i : g_i(u_n) <= g_tol }                                    detect_contact
///     0 <= lambda _|_ H lambda + L v_free >= 0   on A                          solve_impulse
///     v_{n+1/2} = v_free + M^-1 L^T lambda,      u_{n+1} = u_n + dt v_{n+1/2}  correct_velocity
///
/// They are events of -log_view under these names. The interface is gathered where a gap can close
/// (GapWatch) or a look is asked for. The last interaction of a step.
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
  /// Solves for the impulses, and corrects.
  void push(const interactions::Step& step) override;
  void finish(const interactions::Step& step) override;
  void save(SavedState& saved) const override;
  void load(const SavedState& saved) override;

  GapWatch& watch() { return watch_; }
  /// This rank holds the gaps and impulses of the current step.
  bool interface_known() const { return interface_known_; }
  bool touching() const { return touching_; }
  /// Steps so far in which the interface was looked at; members of the interface only.
  std::int64_t looks() const { return looks_; }

 private:
  void detect_contact(const interactions::Step& step);
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
  bool counts_;  ///< this rank adds the contact work to the ledger
  /// Per structure, the dofs that move its interface: before the step, and their velocity in it.
  std::vector<interactions::Before> before_;
  std::vector<std::vector<double>> velocity_;
  Events events_;
  bool interface_known_ = false;
  bool touching_ = false;
  std::int64_t looks_ = 0;
};

}  // namespace pounding
