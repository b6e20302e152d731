#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "common/batch_value.h"
#include "dynamics/damping_filters.h"
#include "dynamics/kept_forces.h"
#include "dynamics/state.h"
#include "dynamics/update.h"
#include "interactions/interaction.h"
#include "system/linear_system.h"

namespace pounding {

/// Numbers of a structure's dofs that stay as they are: those of its system itself, or of eight
/// systems side by side.
template <typename Number>
using Constants = std::conditional_t<std::is_same_v<Number, double>, std::span<const double>,
                                     std::vector<Number>>;

/// Constants out of one system or of up to eight; `get`: those of a system.
template <typename Number, typename Get>
Constants<Number> constants_of(std::span<const LinearSystem* const> systems, const Get& get) {
  if constexpr (std::is_same_v<Number, double>) {
    return std::invoke(get, *systems.front());
  } else {
    std::vector<Number> all;
    for (std::size_t member = 0; member < systems.size(); ++member) {
      const std::vector<double>& values = std::invoke(get, *systems[member]);
      all.resize(values.size(), Number{});
      for (std::size_t i = 0; i < values.size(); ++i) set_member(all[i], member, values[i]);
    }
    return all;
  }
}

/// One number of each of them likewise.
template <typename Number, typename Get>
Number number_of(std::span<const LinearSystem* const> systems, const Get& get) {
  Number number{};
  for (std::size_t member = 0; member < systems.size(); ++member) {
    set_member(number, member, get(*systems[member]));
  }
  return number;
}

template <typename Number>
struct ActionParts;

/// Wishes for a step beside the motion.
template <typename Number>
struct StepRequest {
  /// K v- of the owned dofs [N/s, N m/s], where the energies before the step are asked for; else
  /// null.
  const Number* stiffness_velocity = nullptr;
  bool forces = false;  ///< at the dofs that are watched
};

/// Takes the forces q = K (u_n + beta v-) of a structure range by range and brings the state there
/// one step on (update.h) while the range is in the nearest cache; the sums for the energy balance
/// are taken on the way. Dofs whose mass is coupled wait for `complete`:
///
///     v+ = v- - h (M + S)^-1 ( f + x + alpha M v- + M iota (a_g - g) )
///
/// v+ is free of contact until `correct` is called.
///
/// `Number`: double for one run; BatchValue for up to eight of the same structure, which may differ
/// in mass, stiffness, damping and ground motion. A step allocates nothing.
template <typename Number>
class StructureStep final : public stiffness::ReceiverOf<Number> {
 public:
  /// References must outlive this object. `systems`: of each run; their loads and supports are
  /// alike. `wait`: all dofs wait until their velocities are found together.
  StructureStep(std::span<const LinearSystem* const> systems, StateOf<Number>& state,
                double time_step, bool wait = false);
  StructureStep(StructureStep&& other) noexcept;
  ~StructureStep() override;

  /// Filters of uniform damping, the most of any run.
  std::size_t filters() const { return filters_.count; }
  /// Dofs whose forces a step can be asked for, and whose velocity `correct` may change. Allocates;
  /// before the first step. `always`: they are kept in every step in which a correction needs them.
  void watch(std::span<const LocalIndex> dofs, bool always);
  /// `duration`: of the velocity's step [s]; `supports`: r_c'' of every column of SupportShapes
  /// [m/s2, rad/s2]; `loads`: f of every load of the scene (LoadShapes), until `sums`.
  void begin(double duration, const std::array<Number, 3>& ground_acceleration,
             const StepRequest<Number>& request, std::span<const Number> supports = {},
             std::span<const double> loads = {});
  void receive(LocalIndex begin, LocalIndex end, const Number* force) override;
  /// v_free of dofs that wait, between the last range and `complete`.
  std::span<Number> waiting() { return waiting_.velocity; }
  /// After every range of the step.
  void complete();
  /// Forces of this step at the watched dofs, where they were asked for.
  const KeptForces<Number>& forces() const { return forces_; }
  /// Force of this step at a watched dof, damping included and that of inelastic elements apart,
  /// where it was asked for; of one run of the batch [N, N m].
  double force(std::size_t member, LocalIndex dof) const {
    const double kept = of_member(forces_.at(dof).acting, member);
    return state_.extra_force.empty() ? kept : kept + of_member(state_.extra_force[dof], member);
  }

  /// See SteppedStructure; of one run of the batch.
  void act(std::size_t member, std::span<const LocalIndex> dofs, std::span<const double> force,
           bool from_rest);
  void remember(std::size_t member, std::span<const LocalIndex> dofs,
                interactions::Before& before) const;
  void correct(std::size_t member, std::span<const LocalIndex> dofs,
               const interactions::Before& before, std::span<const double> velocity);
  /// Sums of the whole step.
  StepSums sums(std::size_t member) const;

 private:
  /// Terms and sums of whole vectors of dofs, as wide as those of the unit.
  struct VectorParts;

  /// How the ground acts on dofs: x y z of one mass, or x y z and three rotations; generalised
  /// coordinates; or each by its direction.
  enum class Order { translations, nodes_of_six, generalised, directions };
  struct Segment {
    LocalIndex begin = 0;
    LocalIndex end = 0;
    Order order = Order::directions;
    bool yields = false;         ///< forces of inelastic elements act there
    bool waits = false;          ///< for the velocities of all that wait
    std::size_t first_node = 0;  ///< of translations, into node_mass_

    bool goes_on(const Segment& next) const {
      return order == next.order && yields == next.yields && waits == next.waits;
    }
  };

  struct Load {
    std::size_t number = 0;  ///< in the scene; of those on water, the direction
    std::span<const LocalIndex> dofs;
    Constants<Number> force;
  };

  void find_segments(bool wait);
  /// The segment of dofs from `dof` on, as long as they are of its kind for sure.
  Segment segment_at(LocalIndex dof, bool wait) const;
  /// Brings dofs of one segment on; `settles`: those that waited.
  void advance(const Segment& segment, LocalIndex begin, LocalIndex end, const Number* force,
               bool settles);
  template <bool any>
  void advance_in_order(const Segment& segment, LocalIndex begin, LocalIndex end,
                        const Number* force, const ActionParts<Number>& parts);
  /// Takes a load's part of the step, which is known before the forces are.
  void add_known(const Load& load, const Number& step) {
    for (std::size_t k = 0; k < load.dofs.size(); ++k) {
      const auto i = static_cast<std::size_t>(load.dofs[k]);
      const Number inverse =
          shares_masses() ? Number{} + system_.inverse_mass[i] : inverse_mass_[i];
      known_step_[i] = known_step_[i] - step * load.force[k] * inverse;
    }
  }
  /// sum_l f_l p_l^T v of the velocities as they are [W].
  Number load_power() const;
  /// w_d^T v of them, of the first run: w_d the ground's load on water [kg m/s].
  std::array<double, 3> water_momentum() const;

  /// Dofs of a mesh have the same masses in all runs of a batch, those of `system_`.
  bool shares_masses() const {
    return !std::is_same_v<Number, double> && system_.generalised == nullptr;
  }

  const LinearSystem& system_;  ///< of the first run
  std::size_t runs_;
  StateOf<Number>& state_;
  std::size_t dofs_;
  Constants<Number> mass_;  ///< empty where runs share masses, as the next one
  Constants<Number> inverse_mass_;
  std::array<Constants<Number>, 3> influence_;  ///< of generalised coordinates
  std::array<Number, 3> gravity_{};
  Number alpha_;
  Number beta_;
  bool filters_forces_ = false;  ///< in one run at least
  Filters<Number> filters_{};    ///< none without uniform damping
  std::vector<Constants<Number>> supports_;
  std::vector<Load> loads_;
  std::vector<Load> water_loads_;  ///< w_d of the ground along each axis; empty without
  std::vector<Segment> segments_;
  std::vector<double> node_mass_;  ///< per node of translations: a third of the memory
  std::vector<double> node_inverse_mass_;
  WaitingDofs<Number> waiting_;  ///< empty if none waits
  std::vector<double> field_;    ///< impulses on a coupled mass, then changes of velocity
  StepTerms<Number> terms_{};
  KeptForces<Number> forces_;
  bool corrections_need_forces_ = false;
  bool always_keeps_ = false;                   ///< forces at watched dofs
  bool keeps_ = false;                          ///< in this step
  const Number* stiffness_velocity_ = nullptr;  ///< see StepRequest
  std::array<Number, 3> ground_step_{};         ///< h (a_g - g)
  std::array<bool, 3> shaken_{};                ///< directions in which these are not zero
  /// h ( sum_c iota_c r_c'' - M^-1 sum_l f_l p_l ) per owned dof; empty without supports and loads.
  std::vector<Number> known_step_;
  std::span<const double> load_values_;  ///< f of all loads of the scene in this step
  std::unique_ptr<VectorParts> vectors_;
  StepTotals<Number> totals_;             ///< beside those of vectors
  Number load_before_{};                  ///< load_power before the step
  std::array<double, 3> water_before_{};  ///< water_momentum before the step
  double added_kinetic_before_ = 0;
};

/// One run of a StructureStep, as the scheme and its interactions see it: alone, or in a batch.
template <typename Number>
class SteppedRun : public interactions::SteppedStructure {
 public:
  /// References must outlive this object; `state`: of the run.
  SteppedRun(StructureStep<Number>& step, std::size_t member, StructureState& state)
      : step_(step), member_(member), state_(state) {}

  const std::vector<double>& displacement() const override { return state_.displacement; }
  const std::vector<double>& velocity() const override { return state_.velocity; }
  /// See StructureStep.
  double force(LocalIndex dof) const { return step_.force(member_, dof); }
  void watch(std::span<const LocalIndex> dofs, bool always) override { step_.watch(dofs, always); }
  void act(std::span<const LocalIndex> dofs, std::span<const double> force,
           bool from_rest) override {
    step_.act(member_, dofs, force, from_rest);
  }
  void remember(std::span<const LocalIndex> dofs, interactions::Before& before) const override {
    step_.remember(member_, dofs, before);
  }
  void correct(std::span<const LocalIndex> dofs, const interactions::Before& before,
               std::span<const double> velocity) override {
    step_.correct(member_, dofs, before, velocity);
  }

 protected:
  StructureStep<Number>& step_;
  std::size_t member_;
  StructureState& state_;
};

}  // namespace pounding
