#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "common/parallel.h"
#include "interactions/coupled_rows.h"
#include "interactions/interaction.h"
#include "solvers/law_solver.h"

namespace pounding::interactions {

/// Rows that push by laws of their own: between the step of the structures without them and contact
/// their forces are solved for together, and v+ and u_{n+1} corrected. The rates that a step ends
/// with come with the gather of the next one, and so does its loss. Every member of the rows
/// computes the same; one adds it to the ledger. `Rows`: CoupledRows, or ones that gather the
/// elongations of their laws.
template <typename Rows>
class LawRows : public Interaction {
 public:
  void attach(std::span<SteppedStructure* const> structures) override { rows_.attach(structures); }

 protected:
  /// `make_rows()` gives the rows, `make_laws` of them a law for each. Collective over `comm`.
  template <typename MakeRows, typename MakeLaws>
  LawRows(MPI_Comm comm, double time_step, const MakeRows& make_rows, const MakeLaws& make_laws)
      : rows_(make_rows()),
        counts_(rows_.rows().root() == rank_of(comm)),
        time_step_(time_step),
        laws_(make_laws(rows_)),
        memory_(laws_),
        solver_(laws_, rows_.couplings(), {}, time_step),
        elongations_(laws_.size()) {
    for (auto* values : {&rate_, &rate_before_, &force_, &held_, &driven_, &impulse_}) {
      values->assign(laws_.size(), 0.0);
    }
  }

  /// Takes e_n and its rate, supports moving by these. Members only, as the next one.
  void take_state(const Step& step, std::span<const double> displacement,
                  std::span<const double> velocity) {
    rows_.begin(step, displacement, velocity);
    rate_before_.swap(rate_);
    rows_.gather(elongations_.now, rate_);
    for (std::size_t r = 0; r < laws_.size(); ++r) {
      elongations_.before[r] = elongations_.now[r] - time_step_ * rate_[r];
    }
  }
  /// Solves for the forces of the step, and pushes by them.
  void respond(const Step& step, std::span<const double> supports) {
    auto& [before, now, free_after] = elongations_;
    rows_.take_velocities(step, supports);
    rows_.gather(impulse_, free_after);  // the rates alone are used
    for (std::size_t r = 0; r < laws_.size(); ++r) {
      free_after[r] = now[r] + time_step_ * free_after[r];
    }
    std::ranges::fill(force_, 0.0);
    solver_.solve(step.share(), elongations_, driven_, memory_, force_);
    for (std::size_t r = 0; r < laws_.size(); ++r) {
      impulse_[r] = -Rows::sense * (step.share() * time_step_ * force_[r]);
    }
    rows_.push(step, impulse_);
  }

  Rows rows_;
  bool counts_;  ///< this rank adds to the ledger
  double time_step_;
  std::vector<std::unique_ptr<LinkLaw>> laws_;
  LawMemory memory_;
  LawSolver solver_;
  Elongations elongations_;
  std::vector<double> rate_;         ///< of e, at the start of the step
  std::vector<double> rate_before_;  ///< at that of the step before
  std::vector<double> force_;        ///< N_n
  std::vector<double> held_;         ///< W_{n-1/2}
  std::vector<double> driven_;       ///< no wave drives these rows: zeros
  std::vector<double> impulse_;
  bool made_ = false;  ///< a step was
};

}  // namespace pounding::interactions
