#pragma once

#include <span>
#include <vector>

#include "dynamics/state.h"
#include "dynamics/step_sums.h"
#include "dynamics/structure_step.h"
#include "dynamics/tension_law.h"
#include "system/tension_bars.h"
#include "system/trace.h"

namespace pounding {

/// The tension-only bars' part of a step of their structure, on the rank that owns their nodes:
/// once the step without them is made, their tensions are solved for (TensionLaw; bars that move
/// each other by Gauss-Seidel sweeps, which converge since every tension grows with its elongation)
/// and v+ and u_{n+1} corrected at the dofs that they move. Contact comes after them; where it acts
/// on the nodes of a bar that switches in the same step, the bar's work differs from what its
/// energy takes by what contact changed, and the ledger shows it as loss. Local.
class TensionBarStep {
 public:
  /// `system` has tension-only bars. References must outlive this object.
  TensionBarStep(const LinearSystem& system, const StructureState& state, StructureStep& step,
                 double time_step);

  /// Before the structure's step to t_n: e_n, e_{n-1}, and what the dofs hold.
  void begin();
  /// After it: tensions, v+, u_{n+1}. `first`: half a step from v_0, with the tension of u_0.
  void pull(bool first);
  /// After contact: adds the bars' energy before the step and their loss in it.
  void finish(StepSums& sums);

 private:
  struct Coupling {
    std::size_t bar = 0;
    double compliance = 0;  ///< dt^2 b_i^T M^-1 b_j [m/N]
  };
  void find_couplings();
  /// Largest change of a tension [N].
  double sweep();
  void measure(const std::vector<double>& owned, std::vector<double>& elongations);

  const StructureState& state_;
  StructureStep& step_;
  double time_step_;
  const std::vector<TensionBar>& bars_;
  Trace trace_;
  StructureStep::Before held_;
  std::vector<TensionLaw> laws_;                ///< per bar
  std::vector<std::vector<Coupling>> coupled_;  ///< per bar: itself first
  std::vector<double> before_;                  ///< e_{n-1} [m]
  std::vector<double> now_;                     ///< e_n
  std::vector<double> after_;                   ///< e_{n+1}
  std::vector<double> free_after_;              ///< e_{n+1} without any bar
  std::vector<double> tension_;                 ///< N_n [N]
  std::vector<double> field_;                   ///< per place of the trace
  std::vector<double> velocity_;                ///< per dof of the trace
};

}  // namespace pounding
