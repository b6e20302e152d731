#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/octet.h"
#include "dynamics/state.h"
#include "dynamics/update.h"
#include "interactions/dashpot_modes.h"
#include "interactions/interaction.h"
#include "system/linear_system.h"

namespace pounding {

/// States of one structure in eight runs, shape (coordinates, runs); see StructureState.
struct OctetState {
  std::vector<Octet> displacement;
  std::vector<Octet> velocity;
  std::vector<std::vector<Octet>> filtered;  ///< by filter
};

/// Brings eight runs of a structure in generalised coordinates one step on together, as
/// StructureStep does one of them (update.h, lane by lane); the runs may differ in mass, stiffness
/// and damping. Each run is an OctetLane of it, which interactions correct alone, but for links
/// that are all dashpots: the step itself brakes those runs by them whose dashpots and masses are
/// those of the scene, before any other interaction. Local; a step allocates nothing.
class OctetStep {
 public:
  /// `systems`: of each run, alike in their numbers of coordinates; their states are zero.
  /// `scene`: the one whose dashpots count.
  OctetStep(std::span<const LinearSystem* const> systems, const LinearSystem& scene,
            double time_step);

  std::size_t coordinates() const { return stiffness_.size(); }
  const OctetState& state() const { return state_; }
  /// The step brakes the run in a lane by its links, which then are no interaction.
  bool brakes(std::size_t lane) const { return braked_[lane]; }

  /// The step with the ground's acceleration [m/s2], gravity apart; `duration`: see
  /// StructureStep::begin; `loads`: f of every load of the scene, the same in all runs;
  /// `with_energies`: those before the step are asked for.
  void step(double duration, const std::array<Octet, 3>& ground_acceleration,
            std::span<const double> loads, bool with_energies);

 private:
  friend class OctetLane;

  /// A coordinate in the middle of a step, before dashpots act: q, f and the force x of extra
  /// damping [N, N m], v_free.
  struct FreeDof {
    Octet stiffness;
    Octet acting;
    Octet extra{};
    Octet velocity;
  };

  /// A load of the structure.
  struct Load {
    std::size_t number = 0;    ///< in the scene
    std::vector<Octet> shape;  ///< M^-1 p of each coordinate
    double value = 0;          ///< f in this step
    Octet step{};              ///< -h f
    Octet gained{};            ///< p^T s
  };

  void take_system(const LinearSystem& system, double time_step, std::size_t lane);
  void take_loads(const LinearSystem& system, std::size_t lane);
  /// Takes the dashpots of the scene, and notes whose run has them and its masses.
  void take_dashpots(std::span<const LinearSystem* const> systems, const LinearSystem& scene);
  /// Velocities of those runs become those after the dashpots.
  void brake();
  template <bool with_energies, bool filtered>
  void advance();

  OctetState state_;
  std::int64_t steps_ = 0;  ///< made
  std::vector<Octet> mass_;
  std::vector<Octet> inverse_mass_;
  std::vector<Octet> stiffness_;
  std::vector<Octet> extra_damping_;  ///< D of each coordinate; empty without
  std::array<std::vector<Octet>, 3> influence_;
  std::vector<Load> loads_;
  std::array<Octet, 3> gravity_{};
  std::array<bool, 3> shaken_{};  ///< directions in which ground or gravity act
  Octet alpha_{};
  Octet beta_{};
  Filters<Octet> filters_{};
  double time_step_;
  StepTerms<Octet> terms_{};
  std::array<Octet, 3> ground_step_{};
  DofSums<Octet> sums_;
  DofEnergies<Octet> energies_;
  std::array<Octet, 3> momentum_{};
  Octet extra_before_{};  ///< v-^T D v- [W]
  Octet device_{};
  std::optional<interactions::DashpotBrake<Octet>> dashpots_;
  std::vector<FreeDof> free_;    ///< per coordinate; empty without dashpots, as the next one
  std::vector<Octet> velocity_;  ///< v_free, then v+
  Octet dashpot_loss_{};         ///< in the step, before contact [J]
  std::array<bool, octet_size> braked_{};
  std::array<bool, octet_size> corrected_{};  ///< lanes in this step
  std::array<StepSums, octet_size> corrections_;
  std::vector<Octet> places_;       ///< u_n at the places of a trace
  std::int64_t places_known_ = -1;  ///< steps made when they were found
};

/// One run of an OctetStep, as the scheme and its interactions see it. Its state is brought to the
/// arrays of a StructureState where they ask for it. Local.
class OctetLane final : public interactions::SteppedStructure {
 public:
  /// Puts `state` into the lane. Both references must outlive this object.
  OctetLane(OctetStep& octet, std::size_t lane, StructureState& state);

  const std::vector<double>& displacement() const override;
  const std::vector<double>& velocity() const override;
  void bring_state() const override;
  /// Found for all lanes at once by the first that asks: their traces are alike.
  std::span<const double> places(const Trace& trace) override;
  void watch(std::span<const LocalIndex> /*dofs*/, bool /*always*/) override {}
  /// Before the step.
  void remember(std::span<const LocalIndex> dofs, interactions::Before& before) const override;
  /// Throws std::logic_error: no element of a reduced structure is inelastic.
  void act(std::span<const LocalIndex> dofs, std::span<const double> force,
           bool from_rest) override;
  void correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
               std::span<const double> velocity) override;
  /// Sums of the last step.
  void sum_up(StepSums& total) const;

 private:
  void take(const std::vector<Octet>& values, std::vector<double>& to) const;

  OctetStep& octet_;
  std::size_t lane_;
  StructureState& state_;
  /// Steps made when displacement, velocity and forces were brought here.
  mutable std::int64_t displacement_known_ = -1, velocity_known_ = -1, forces_known_ = -1;
  mutable std::vector<DofForces> forces_;  ///< of the step, per coordinate
  std::vector<double> places_;
};

}  // namespace pounding
