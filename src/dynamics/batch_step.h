#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/octet.h"
#include "dynamics/state.h"
#include "dynamics/structure_step.h"
#include "interactions/dashpot_modes.h"
#include "interactions/interaction.h"
#include "system/linear_system.h"

namespace pounding {

/// Brings eight runs of a structure in generalised coordinates one step on together
/// (StructureStep). Each run is an OctetLane of it, which interactions correct alone, but for links
/// that are all dashpots: the step itself brakes those runs by them whose dashpots and masses are
/// those of the scene, before any other interaction. Local; a step allocates nothing.
class OctetStep {
 public:
  /// `systems`: of each run, alike in their numbers of coordinates; their states are zero.
  /// `scene`: the one whose dashpots count. All must outlive this object.
  OctetStep(std::span<const LinearSystem* const> systems, const LinearSystem& scene,
            double time_step);

  std::size_t coordinates() const { return stiffness_.size(); }
  const StateOf<Octet>& state() const { return *state_; }
  /// The step brakes the run in a lane by its links, which then are no interaction.
  bool brakes(std::size_t lane) const { return braked_[lane]; }

  /// The step with the ground's acceleration [m/s2], gravity apart; `duration`: see
  /// StructureStep::begin; `loads`: f of every load of the scene, the same in all runs;
  /// `with_energies`, `with_forces`: see CdLagrange::step.
  void step(double duration, const std::array<Octet, 3>& ground_acceleration,
            std::span<const double> loads, bool with_energies, bool with_forces);

 private:
  friend class OctetLane;

  /// Takes the dashpots of the scene, and notes whose run has them and its masses.
  void take_dashpots(std::span<const LinearSystem* const> systems, const LinearSystem& scene);
  /// Velocities of those runs become those after the dashpots; `share`: of a step, for which forces
  /// act.
  void brake(double share);

  std::unique_ptr<StateOf<Octet>> state_;  ///< keeps its place
  std::int64_t steps_ = 0;                 ///< made
  double time_step_;
  std::vector<Octet> stiffness_;
  std::vector<Octet> extra_damping_;  ///< D of each coordinate; empty without
  Octet beta_;
  std::optional<interactions::DashpotBrake<Octet>> dashpots_;
  std::array<bool, octet_size> braked_{};
  Octet dashpot_loss_{};              ///< in the step [J]
  std::vector<Octet> free_velocity_;  ///< before the dashpots; empty without
  std::optional<StructureStep<Octet>> structure_;
  std::vector<Octet> force_;               ///< q
  std::vector<Octet> stiffness_velocity_;  ///< K v-
  Octet extra_before_{};                   ///< v-^T D v- [W]
  std::vector<Octet> places_;              ///< u_n at the places of a trace
  std::int64_t places_known_ = -1;         ///< steps made when they were found
};

/// One run of an OctetStep, as the scheme and its interactions see it. Its state is brought to the
/// arrays of a StructureState where they ask for it. Local.
class OctetLane final : public SteppedRun<Octet> {
 public:
  /// Puts `state` into the lane. Both references must outlive this object.
  OctetLane(OctetStep& octet, std::size_t lane, StructureState& state);

  const std::vector<double>& displacement() const override;
  const std::vector<double>& velocity() const override;
  void bring_state() const override;
  /// Found for all lanes at once by the first that asks: their traces are alike.
  std::span<const double> places(const Trace& trace) override;
  void correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
               std::span<const double> velocity) override;
  /// Sums of the last step.
  StepSums sums() const;

 private:
  void take(const std::vector<Octet>& values, std::vector<double>& to) const;

  OctetStep& octet_;
  /// Steps made when displacement and velocity were brought here.
  mutable std::int64_t displacement_known_ = -1, velocity_known_ = -1;
  std::vector<double> places_;
};

}  // namespace pounding
