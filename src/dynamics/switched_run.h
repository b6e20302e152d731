#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/saved_state.h"
#include "dynamics/energy_balance.h"
#include "dynamics/structure_step.h"
#include "interactions/links_in_modes.h"

namespace pounding {

/// Modes in which a structure is stepped while nothing strikes it, u = Phi q.
struct SwitchedModes {
  /// Every rank has all coordinates, alike; `generalised->rows` is Phi at the dofs that the rank
  /// owns of the mesh, row by row. No links.
  LinearSystem system;
  interactions::AllLinks links;
  double part = 0;  ///< of its largest energy that may lie outside [-]

  std::size_t size() const { return system.lumped_mass.size(); }  ///< of q
  /// Phi of an owned dof, shape (size).
  const double* row(std::size_t dof) const {
    return system.generalised->rows.data() + dof * size();
  }
  std::vector<double> squares() const;  ///< omega^2, per coordinate [1/s2]
  /// Phi^T w of owned dofs, of some or of all. Local.
  std::vector<double> weighted(std::span<const LocalIndex> dofs,
                               std::span<const double> weights) const;
  std::vector<double> weighted(std::span<const double> weights) const;
};

/// A structure that the step takes in modes or at full order. Its modes are stepped by the scheme
/// of the whole (StructureStep), so that a motion in their space is the same motion in either: only
/// the part outside the basis is lost on the way to modes,
///
///     q = Phi^T M u,   q' = Phi^T M v,   z_i = Phi^T Z_i
///     E_out = E(u - Phi q, v - Phi q'),  E the energy of the ledger (EnergyBalance)
///
/// and nothing on the way back, u = Phi q, v = Phi q', Z_i = K Phi diag(omega^-2) z_i, the memory
/// of a rest being left as it is. The basis holds the static responses to weight, loads and the
/// ground, so that these are no part of E_out. In modes the arrays of its StructureState are out of
/// date until they are brought.
class SwitchedRun final : public SteppedRun<double> {
 public:
  /// `number`: of the structure in `energy`; `step` and `state`: at full order. All references must
  /// outlive this object.
  SwitchedRun(const LinearSystem& system, std::size_t number, StructureStep<double>& step,
              StructureState& state, EnergyBalance& energy, double time_step);

  bool in_modes() const override { return in_modes_; }
  void bring(std::span<const LocalIndex> dofs) const override;
  void take_links(std::span<double> memory) override { links_.take(memory); }
  void bring_all() const;
  /// q, on every rank.
  std::span<const double> coordinates() const { return q_.displacement; }

  /// Projects the state at full order; whether E_out is no more than its part of the largest energy
  /// so far. Collective over the structure's ranks, as the next two.
  bool fits_modes();
  /// Goes to the modes that `fits_modes` found, or back; the ledger books the change of energy.
  void enter_modes();
  void leave_modes();

  /// One step in modes, of which `forces` may be asked for; see StructureStep::begin. Local.
  void step(const std::array<double, 3>& ground_acceleration, bool with_energies, bool with_forces,
            std::span<const double> supports, std::span<const double> loads);
  /// Force of that step on a coordinate, damping included, and that of a link of this rank.
  double coordinate_force(std::size_t j) const {
    return step_in_modes_.force(0, static_cast<LocalIndex>(j));
  }
  double link_force(std::size_t link) const { return links_.force(link); }
  /// Sums of that step, on the first rank; zero on others.
  StepSums sums() const;
  /// See rest_work; likewise.
  double about_rest() const;

  /// Saves before the links are saved, or brings back after they were, which is collective.
  void keep(const StateKeeper& state);

 private:
  /// Phi q of all owned dofs.
  void expand(const std::vector<double>& q, std::vector<double>& values) const;
  /// Energies of a state, as a step that starts from it would leave them. Collective over the
  /// system's communicator.
  StepSums energies(const LinearSystem& system, const std::vector<double>& displacement,
                    const std::vector<double>& velocity) const;
  StepSums energies_in_modes() const;
  StepSums energies_at_full_order() const;
  /// Largest energy so far, with that of the motion in modes about the rest and `outside` [J].
  void note_energy(double outside);

  const LinearSystem& system_;
  const SwitchedModes& modes_;
  std::size_t number_;
  EnergyBalance& energy_;
  double time_step_;
  bool first_rank_;
  State coordinates_;
  StructureState& q_;                         ///< the only one of these
  std::vector<std::vector<double>*> fields_;  ///< q, q' and z_i of it
  StructureStep<double> step_in_modes_;
  interactions::LinksInModes links_;
  std::vector<LocalIndex> all_;  ///< coordinates
  interactions::Before before_;
  std::vector<double> velocity_;
  std::vector<double> stiffness_velocity_;
  std::vector<double> rest_force_;  ///< K u_0 over the coordinates; empty without
  double largest_energy_ = 0;       ///< of the motion about the rest [J]
  bool in_modes_ = false;
};

}  // namespace pounding
