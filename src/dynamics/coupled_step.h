#pragma once

#include <array>
#include <vector>

#include "dynamics/state.h"
#include "dynamics/step_sums.h"
#include "system/linear_system.h"

namespace pounding {

/// The step of those dofs of a rank whose mass is not diagonal:
///
///     v+ = v- - dt (M + S)^-1 ( q + x + alpha M v- + M iota (a_g - g) ),      q = K (u_n + beta
///     v-)
///
/// Their forces are kept as they come; when all are there, the velocities are solved for and the
/// state is brought one step on. Allocates nothing.
class CoupledStep {
 public:
  /// The system has a coupled mass. References must outlive this object.
  CoupledStep(const LinearSystem& system, BodyState& state, double time_step);

  /// What a step is made with.
  struct Terms {
    double duration = 0;                  ///< of the velocity's step [s]
    double inverse = 0;                   ///< 1 / (beta + dt), 0 in the first step
    std::array<double, 3> ground_step{};  ///< duration (a_g - g) [m/s]
  };

  /// q of coupled dofs that follow each other, `place` the number of the first among them all.
  void keep(std::size_t place, std::size_t count, const double* force);
  /// After every force of the step; sums are added to.
  void advance(const Terms& terms, bool with_energies, StepSums& sums);

 private:
  struct Node {
    std::size_t begin = 0;  ///< first dof
    std::size_t count = 0;
    std::size_t force = 0;  ///< place in force_
    std::size_t field = 0;  ///< place in field_
    bool regular = false;   ///< x y z and three rotations, no devices: goes by vectors
  };

  void add_energies(StepSums& sums) const;
  void form_impulses(const Terms& terms);
  void form_regular(const Node& node, const Terms& terms);
  void advance_regular(const Terms& terms, StepSums& sums);
  void advance_dofs(const Node& node, const Terms& terms, StepSums& sums);

  const LinearSystem& system_;
  BodyState& state_;
  double time_step_;
  std::vector<Node> nodes_;
  std::vector<double> force_;  ///< q, in the order of the dofs
  std::vector<double> field_;  ///< impulses, then changes of velocity; see CoupledMass
};

}  // namespace pounding
