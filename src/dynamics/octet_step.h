#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/octet.h"
#include "dynamics/contact_correction.h"
#include "dynamics/state.h"
#include "dynamics/step_sums.h"
#include "dynamics/update.h"
#include "system/linear_system.h"

namespace pounding {

/// States of one structure in eight runs, shape (coordinates, runs); see StructureState.
struct OctetState {
  std::vector<Octet> displacement;
  std::vector<Octet> velocity;
  std::vector<std::vector<Octet>> filtered;  ///< by filter

  /// Room for a structure with so many coordinates and filters, all zero.
  OctetState(std::size_t coordinates, std::size_t filters);
  void put(std::size_t lane, const StructureState& state);
  /// Displacements or velocities of a run alone.
  static void take(const std::vector<Octet>& values, std::size_t lane, std::span<double> to);
};

/// Brings eight runs of a structure in generalised coordinates one step on together, as
/// StructureStep does one of them (update.h, lane by lane); the runs may differ in mass, stiffness
/// and damping. A run that contact changes is then corrected alone. Local; a step allocates
/// nothing.
class OctetStep {
 public:
  /// `systems`: of each run, alike in their numbers of coordinates; null where there is none. They
  /// must outlive this object.
  OctetStep(std::span<const LinearSystem* const> systems, double time_step);

  std::size_t coordinates() const { return stiffness_.size(); }
  std::size_t filters() const { return filters_.count; }

  /// The step with the ground's acceleration [m/s2], gravity apart; `duration`: see
  /// StructureStep::begin; `with_energies`: those before the step are asked for.
  void step(double duration, const std::array<Octet, 3>& ground_acceleration, bool with_energies,
            OctetState& state);

  /// One run's state before a step, and the forces of the step.
  struct Before {
    explicit Before(std::size_t coordinates)
        : displacement(coordinates), velocity(coordinates), forces(coordinates) {}
    std::vector<double> displacement;
    std::vector<double> velocity;
    std::vector<DofForces> forces;
  };
  void remember(const OctetState& state, std::size_t lane, Before& before) const;
  /// v+ = `velocity` of one run, after contact; sums and displacement follow.
  void correct(std::size_t lane, const Before& before, std::span<const double> velocity,
               OctetState& state);
  /// Sums of the last step of one run.
  StepSums sums(std::size_t lane) const;

 private:
  void take_system(const LinearSystem& system, double time_step, std::size_t lane);
  template <bool with_energies, bool filtered>
  void advance(OctetState& state);

  std::vector<Octet> mass_;
  std::vector<Octet> inverse_mass_;
  std::vector<Octet> stiffness_;
  std::vector<Octet> extra_damping_;  ///< D of each coordinate; empty without
  std::array<std::vector<Octet>, 3> influence_;
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
  std::array<StepSums, octet_size> corrections_;
};

}  // namespace pounding
