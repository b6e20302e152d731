#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <mpi.h>

#include "interactions/coupled_rows.h"
#include "interactions/interaction.h"
#include "interactions/pairing/interface.h"
#include "solvers/law_solver.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// Rows of an interface's soil between mats, with their elongations and impulses. Collective over
/// `comm`.
CoupledRows make_soil_rows(MPI_Comm comm, const Interface& interface,
                           std::span<const LinearSystem> systems, std::span<const Mesh> meshes);

/// Soil that mats of several structures share (SoilRow), but for the springs of each mat, which its
/// structure has in K: springs between mats pull by e_n, dashpots, masses and hidden motions
/// (SoilLaw) are solved for together, and v+ and u_{n+1} corrected. The rates that a step ends with
/// come with the gather of the next one, and so do hidden motions and loss. Every member of the
/// rows computes the same; one adds it to the ledger. Supports move all ground of a structure, with
/// which its u and the soil under it go, so that no support works on these rows.
class SoilRows final : public Interaction {
 public:
  /// References must outlive this object. Collective over `comm`.
  SoilRows(MPI_Comm comm, const Interface& interface, std::span<const LinearSystem> systems,
           std::span<const Mesh> meshes, double time_step);

  void attach(std::span<SteppedStructure* const> structures) override { rows_.attach(structures); }
  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  void keep(const StateKeeper& state) override;

  /// N_n of a row of the interface's soil in the step just made [N, N m]; 0 but on members.
  double force(std::size_t row) const { return force_[row]; }

 private:
  /// Closes the step before, `share` of one, with the rates that it ended with.
  void close_step_before(double share);

  CoupledRows rows_;
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
  double loss_ = 0;    ///< of the step before [J]
  bool made_ = false;  ///< a step was
};

}  // namespace pounding::interactions
