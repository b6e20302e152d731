#pragma once

#include <array>
#include <span>
#include <vector>

#include "dynamics/state.h"
#include "dynamics/update.h"
#include "system/linear_system.h"

namespace pounding {

/// The step of those dofs of a rank whose mass is not diagonal (see update.h for the others):
///
///     v+ = v- - h (M + S)^-1 ( f + x + alpha M v- + M iota (a_g - g) )
///
/// with f = q but for uniform damping, which filters it.
/// Their forces are kept as they come; when all are there, the velocities are solved for and the
/// state is brought one step on. Allocates nothing.
class CoupledStep {
 public:
  /// The system has a coupled mass. References must outlive this object.
  CoupledStep(const LinearSystem& system, StructureState& state, const Filters<double>& filters);

  /// q of coupled dofs that follow each other, `place` the number of the first among them all.
  void keep(std::size_t place, std::size_t count, const double* force);
  /// After every force of the step. `ground_step`: h (a_g - g) [m/s]; `known_step`: motion that
  /// supports that move on their own and loads add to it per owned dof, empty without;
  /// `stiffness_velocity`: see StepRequest. Adds to the sums.
  void advance(const StepTerms<double>& terms, const std::array<double, 3>& ground_step,
               std::span<const double> known_step, const double* stiffness_velocity,
               DofSums<double>& dof_sums, DofEnergies<double>& dof_energies, StepSums& sums);

 private:
  struct Node {
    std::size_t begin = 0;  ///< first dof
    std::size_t count = 0;
    std::size_t force = 0;  ///< place in force_
    std::size_t field = 0;  ///< place in field_
    bool regular = false;   ///< x y z and three rotations, no extra forces: goes by vectors
  };

  void form_impulses(const StepTerms<double>& terms, const std::array<double, 3>& ground_step);
  void form_regular(const Node& node, const StepTerms<double>& terms,
                    const std::array<double, 3>& ground_step);
  /// Force of inelastic elements on an owned dof.
  double inelastic(std::size_t dof) const {
    return state_.inelastic_force.empty() ? 0 : state_.inelastic_force[dof];
  }
  /// f of all dofs from q, inelastic elements and the filters' memories.
  void filter_forces();
  /// Takes the loads of the supports off the impulses.
  void add_known_loads(std::span<const double> known_step);
  /// Their work on v+ + v-, after the step [J].
  double known_work(std::span<const double> known_step) const;
  /// The part of the energy balance that stems from f - q.
  double filtered_work() const;
  template <bool with_energies>
  void settle_nodes(const StepTerms<double>& terms, const double* stiffness_velocity,
                    DofSums<double>& dof_sums, DofEnergies<double>& dof_energies, StepSums& sums);
  template <bool with_energies>
  void settle_dofs(const Node& node, const StepTerms<double>& terms,
                   const double* stiffness_velocity, DofSums<double>& dof_sums,
                   DofEnergies<double>& dof_energies, StepSums& sums);

  const LinearSystem& system_;
  StructureState& state_;
  std::vector<Node> nodes_;
  Filters<double> filters_;
  std::vector<double> force_;     ///< q, in the order of the dofs
  std::vector<double> filtered_;  ///< f likewise; empty without uniform damping
  std::vector<double> field_;     ///< impulses, then changes of velocity; see CoupledMass
};

}  // namespace pounding
