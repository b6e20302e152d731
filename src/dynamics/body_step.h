#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/lanes.h"
#include "dynamics/coupled_step.h"
#include "dynamics/state.h"
#include "dynamics/step_sums.h"
#include "system/linear_system.h"

namespace pounding {

/// Takes the forces q = K (u_n + beta v-) of a structure range by range and brings the state there
/// one step on:
///
///     v+      = (1 - dt alpha) v- - dt M^-1 (q + x) - dt (a_g - g) iota
///     u_{n+1} = u_n + dt v+
///     K v-    = (q - K u_{n-1}) / (beta + dt)
///     K u_n   = K u_{n-1} + dt K v-
///
/// with half the dt in v+ at the start. All of it while the range is in the nearest cache; the sums
/// for the energy balance are taken on the way. Dofs whose mass is coupled wait for `complete`. v+
/// is free of contact until `correct` is called.
class BodyStep final : public ForceReceiver {
 public:
  /// References must outlive this object.
  BodyStep(const LinearSystem& system, BodyState& state, double time_step);

  /// `duration`: of the velocity's step [s]; `first`: K u_{n-1} holds K u_n already and stays.
  void begin(double duration, const std::array<double, 3>& ground_acceleration, bool first,
             bool with_energies);
  void receive(LocalIndex begin, LocalIndex end, const double* force) override;
  /// After every range of the step.
  void complete();
  /// What some dofs held before the step.
  struct Before {
    explicit Before(std::size_t dofs)
        : displacement(dofs), velocity(dofs), stiffness_displacement(dofs) {}
    std::vector<double> displacement;
    std::vector<double> velocity;
    std::vector<double> stiffness_displacement;
  };
  void remember(std::span<const LocalIndex> dofs, Before& before) const;
  /// v+ = `velocity` at these dofs, after contact; sums and displacement follow.
  void correct(std::span<const LocalIndex> dofs, const Before& before,
               std::span<const double> velocity);
  /// Sums of the whole step.
  StepSums sums() const;

 private:
  static constexpr std::size_t pattern_lanes = 3;  // vectors in which directions repeat: 12 dofs

  /// Dofs whose directions repeat: x y z of one mass, or x y z and three rotations; generalised
  /// coordinates; dofs of coupled mass; or in no order.
  enum class Order { translations, nodes_of_six, generalised, coupled, none };
  struct Segment {
    LocalIndex begin = 0;
    LocalIndex end = 0;
    Order order = Order::none;
    std::size_t first_node = 0;     ///< of translations, into node_mass_
    std::size_t first_coupled = 0;  ///< of coupled dofs, their number among all of them
  };
  /// Per lane.
  struct Sums {
    Lanes stiffness_before{};
    Lanes stiffness_across{};
    Lanes mass_sum{};
    Lanes kinetic_before{};
    Lanes strain_before{};
    Lanes displacement_mass{};
    Lanes momentum[2][pattern_lanes]{};  ///< of nodes without and with rotations
  };

  void find_segments();
  Order order_at(std::size_t dof) const;
  std::size_t length_at(std::size_t dof, Order order) const;
  template <bool with_energies>
  void advance(const Segment& segment, LocalIndex begin, LocalIndex end, const double* force);
  /// Whole vectors of dofs whose directions repeat every three vectors.
  template <bool with_energies, typename Masses>
  void advance_patterns(std::size_t first, std::size_t end, const double* force, Masses masses,
                        const Lanes* ground, Lanes* momentum);
  /// Whole vectors of generalised coordinates.
  template <bool with_energies>
  void advance_generalised(std::size_t first, std::size_t end, const double* force);
  template <bool with_energies>
  void advance_dof(LocalIndex dof, double force);
  /// dt (a_g - g) iota of a dof.
  double ground_step_at(std::size_t dof) const;
  /// Adds to iota_d^T M s what M s is at a dof.
  void add_momentum(std::size_t dof, double momentum);

  const LinearSystem& system_;
  BodyState& state_;
  double time_step_;
  std::vector<Segment> segments_;
  std::vector<double> node_mass_;  ///< per node of translations: a third of the memory
  std::vector<double> node_inverse_mass_;
  std::unique_ptr<CoupledStep> coupled_;  ///< null if no mass is coupled here
  double duration_ = 0;
  double decay_ = 1;
  double inverse_ = 0;  ///< 1 / (beta + dt), 0 in the first step
  bool with_energies_ = false;
  std::array<double, 3> ground_step_{};
  Lanes ground_[2][pattern_lanes]{};  ///< of nodes without and with rotations
  Sums sums_;
  StepSums single_;  ///< of dofs taken one by one
};

}  // namespace pounding
