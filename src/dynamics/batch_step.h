#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/batch_value.h"
#include "dynamics/state.h"
#include "dynamics/structure_step.h"
#include "interactions/dashpot_modes.h"
#include "interactions/interaction.h"
#include "stiffness/batch_stiffness.h"
#include "system/linear_system.h"

namespace pounding {

/// Brings eight runs of a structure one step on together (StructureStep), in generalised
/// coordinates or at full order. Each run is a BatchMember of it, which interactions correct alone,
/// but for links of generalised coordinates that are all dashpots: the step itself brakes those
/// runs by them whose dashpots and masses are those of the scene, before any other interaction.
/// Local; a step allocates nothing.
class BatchStep {
 public:
  /// `systems`: of each run, alike in their numbers of coordinates; their states are zero.
  /// `scene`: the one whose dashpots count. `elements`: K of all runs at full order, which have the
  /// same masses and no extra damping, mass that is coupled or elements with laws. All must outlive
  /// this object.
  BatchStep(std::span<const LinearSystem* const> systems, const LinearSystem& scene,
            double time_step, const stiffness::BatchStiffness* elements = nullptr);
  /// Memory per dof of eight runs at full order, their own states included [bytes].
  static double memory_per_dof(const LinearSystem& system);

  std::size_t coordinates() const { return state_->displacement.size(); }
  const StateOf<BatchValue>& state() const { return *state_; }
  /// The step brakes a member by its links, which then are no interaction.
  bool brakes(std::size_t member) const { return braked_[member]; }

  /// The step with the ground's acceleration [m/s2], gravity apart; `duration`, `supports`: see
  /// StructureStep::begin; `loads`: f of every load of the scene, the same in all runs;
  /// `with_energies`, `with_forces`: see CdLagrange::step.
  void step(double duration, const std::array<BatchValue, 3>& ground_acceleration,
            std::span<const BatchValue> supports, std::span<const double> loads, bool with_energies,
            bool with_forces);

 private:
  friend class BatchMember;

  void take_diagonals(std::span<const LinearSystem* const> systems);
  /// Forces of generalised coordinates.
  void multiply_diagonals(bool with_energies);
  /// Takes the dashpots of the scene, and notes whose run has them and its masses.
  void take_dashpots(std::span<const LinearSystem* const> systems, const LinearSystem& scene);
  /// Velocities of those runs become those after the dashpots; `share`: of a step, for which forces
  /// act.
  void brake(double share);

  std::unique_ptr<StateOf<BatchValue>> state_;  ///< keeps its place
  std::int64_t steps_ = 0;                      ///< made
  double time_step_;
  const stiffness::BatchStiffness* elements_;
  std::vector<BatchValue> stiffness_;      ///< of generalised coordinates, as the next one
  std::vector<BatchValue> extra_damping_;  ///< D of each coordinate; empty without
  BatchValue beta_;
  std::optional<interactions::DashpotBrake<BatchValue>> dashpots_;
  std::array<bool, batch_size> braked_{};
  BatchValue dashpot_loss_{};              ///< in the step [J]
  std::vector<BatchValue> free_velocity_;  ///< before the dashpots; empty without
  std::optional<StructureStep<BatchValue>> structure_;
  std::vector<BatchValue> force_;               ///< q of generalised coordinates
  std::vector<BatchValue> stiffness_velocity_;  ///< K v-
  BatchValue extra_before_{};                   ///< v-^T D v- [W]
  std::vector<BatchValue> points_;              ///< u_n at the points of a trace
  std::int64_t points_known_ = -1;              ///< steps made when they were found
};

/// One run of a BatchStep, as the scheme and its interactions see it. Its state is brought to the
/// arrays of a StructureState where they ask for it. Local.
class BatchMember final : public SteppedRun<BatchValue> {
 public:
  /// Puts `state` into the batch. Both references must outlive this object.
  BatchMember(BatchStep& batch, std::size_t member, StructureState& state);

  /// All coordinates; at full order the watched dofs, unless the state has been brought.
  const std::vector<double>& displacement() const override;
  const std::vector<double>& velocity() const override;
  void watch(std::span<const LocalIndex> dofs, bool always) override;
  void bring_state() const override;
  /// Found for all members at once by the first that asks: their traces are alike. None at full
  /// order, where a point is a dof.
  std::span<const double> points(const Trace& trace) override;
  void correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
               std::span<const double> velocity) override;
  /// Sums of the last step.
  StepSums sums() const;
  /// v- + v+ of a coordinate, before contact, in a step that braked it by its dashpots.
  double braked(std::size_t coordinate) const {
    return batch_.dashpots_->sums()[coordinate][member_];
  }

 private:
  void take(const std::vector<BatchValue>& values, std::vector<double>& to) const;
  /// All coordinates, or the watched dofs of a mesh.
  void take_asked(const std::vector<BatchValue>& values, std::vector<double>& to) const;

  BatchStep& batch_;
  /// Steps made when displacement and velocity were brought here.
  mutable std::int64_t displacement_known_ = -1, velocity_known_ = -1;
  mutable std::int64_t state_known_ = -1;  ///< the whole of it
  std::vector<LocalIndex> watched_;        ///< of a mesh, increasing
  std::vector<double> points_;
};

}  // namespace pounding
