#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "dynamics/coupled_step.h"
#include "dynamics/kept_forces.h"
#include "dynamics/state.h"
#include "dynamics/update.h"
#include "interactions/interaction.h"
#include "system/linear_system.h"

namespace pounding {

/// Numbers of the filters of a system's uniform damping; none without.
Filters<double> filters_of(const LinearSystem& system, double time_step);

/// Memories of the filters of a structure that has stood at u_0 for ever: W_i = K u_0. Collective
/// over the system's communicator.
void start_filters(const LinearSystem& system, double time_step, StructureState& state);

/// Wishes for a step beside the motion.
struct StepRequest {
  /// K v- of the owned dofs [N/s, N m/s], where the energies before the step are asked for; else
  /// null.
  const double* stiffness_velocity = nullptr;
  bool forces = false;  ///< at the dofs that are watched
};

/// Takes the forces q = K (u_n + beta v-) of a structure range by range and brings the state there
/// one step on (update.h) while the range is in the nearest cache; the sums for the energy balance
/// are taken on the way. Dofs whose mass is coupled wait for `complete`. v+ is free of contact
/// until `correct` is called.
class StructureStep final : public stiffness::ForceReceiver, public interactions::SteppedStructure {
 public:
  /// References must outlive this object.
  StructureStep(const LinearSystem& system, StructureState& state, double time_step);
  StructureStep(StructureStep&& other) noexcept;
  ~StructureStep() override;

  const std::vector<double>& displacement() const override { return state_.displacement; }
  const std::vector<double>& velocity() const override { return state_.velocity; }
  /// Dofs whose forces a step can be asked for, and whose velocity `correct` may change. Allocates;
  /// before the first step. `always`: they are kept in every step in which a correction needs them.
  void watch(std::span<const LocalIndex> dofs, bool always) override;
  /// `duration`: of the velocity's step [s]; `supports`: r_c'' of every column of SupportShapes
  /// [m/s2, rad/s2]; `loads`: f of every load of the scene (LoadShapes), until `sums`.
  void begin(double duration, const std::array<double, 3>& ground_acceleration,
             const StepRequest& request, std::span<const double> supports = {},
             std::span<const double> loads = {});
  void receive(LocalIndex begin, LocalIndex end, const double* force) override;
  /// After every range of the step.
  void complete();
  void act(std::span<const LocalIndex> dofs, std::span<const double> force,
           bool from_rest) override;
  void remember(std::span<const LocalIndex> dofs, interactions::Before& before) const override;
  /// Forces of this step at the watched dofs, where they were asked for.
  const KeptForces& forces() const { return forces_; }
  /// v+ = `velocity` at these dofs; sums and displacement follow. The dofs are watched, and their
  /// forces were asked for.
  void correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
               std::span<const double> velocity) override;
  /// Sums of the whole step.
  StepSums sums() const;

 private:
  /// Terms and sums of whole vectors of dofs, as wide as those of the unit.
  struct VectorParts;

  /// Dofs whose directions repeat: x y z of one mass, or x y z and three rotations; generalised
  /// coordinates; dofs of coupled mass; or in no order, as where extra damping acts.
  enum class Order { translations, nodes_of_six, generalised, coupled, none };
  struct Segment {
    LocalIndex begin = 0;
    LocalIndex end = 0;
    Order order = Order::none;
    bool yields = false;            ///< forces of inelastic elements act there
    std::size_t first_node = 0;     ///< of translations, into node_mass_
    std::size_t first_coupled = 0;  ///< of coupled dofs, their number among all of them
  };

  void find_segments(const std::vector<char>& acted_on);
  /// Whether a law of inelastic elements may act on one of these dofs.
  bool is_inelastic(std::size_t dof, std::size_t count) const;
  Order order_at(std::size_t dof, const std::vector<char>& acted_on) const;
  std::size_t length_at(std::size_t dof, Order order) const;
  /// Brings dofs of one segment on, or keeps their forces where their mass is coupled.
  void advance(const Segment& segment, LocalIndex begin, LocalIndex end, const double* force);
  /// Dofs of an order other than coupled and none; `others`: OtherActions or NothingElse.
  template <typename Others>
  void advance_in_order(const Segment& segment, LocalIndex begin, LocalIndex end,
                        const double* force, Others& others);
  /// Dofs by vectors: policies give their masses, the effect of the ground, and other actions.
  template <typename Others, typename Masses, typename Ground>
  void advance_vectors(std::size_t first, std::size_t end, const double* force, Others& others,
                       Masses masses, Ground& ground);
  /// Adds the energies before the step, by vectors.
  void add_energies_before(std::size_t first, std::size_t end, const double* force);
  /// Dofs one by one.
  void advance_dofs(std::size_t first, std::size_t end, const double* force);
  /// h ((a_g - g) iota + sum_c iota_c r_c'' - M^-1 sum_l f_l p_l) of a dof.
  double ground_step_at(std::size_t dof) const;
  /// Adds to iota_d^T M s, and to the work of supports and loads, M s at a dof.
  void add_momentum(std::size_t dof, double momentum);
  /// sum_l f_l p_l^T v of the velocities as they are [W].
  double load_power() const;

  const LinearSystem& system_;
  StructureState& state_;
  std::vector<Segment> segments_;
  std::vector<double> node_mass_;  ///< per node of translations: a third of the memory
  std::vector<double> node_inverse_mass_;
  std::unique_ptr<CoupledStep> coupled_;  ///< null if no mass is coupled here
  StepTerms<double> terms_{};
  Filters<double> filters_{};  ///< none without uniform damping
  KeptForces forces_;
  bool always_keeps_ = false;                   ///< forces at watched dofs
  bool keeps_ = false;                          ///< in this step
  const double* stiffness_velocity_ = nullptr;  ///< see StepRequest
  std::array<double, 3> ground_step_{};
  /// h ( sum_c iota_c r_c'' - M^-1 sum_l f_l p_l ) per owned dof; empty without supports and loads.
  std::vector<double> known_step_;
  std::span<const double> load_values_;  ///< f of all loads of the scene in this step
  std::unique_ptr<VectorParts> vectors_;
  DofSums<double> dof_sums_;
  DofEnergies<double> dof_energies_;
  StepSums sums_;  ///< parts of single dofs beside dof_sums_
};

}  // namespace pounding
