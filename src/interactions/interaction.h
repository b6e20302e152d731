#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/profile.h"
#include "common/saved_state.h"
#include "common/types.h"
#include "system/trace.h"

namespace pounding::interactions {

/// Motion of supports relative to the scene's ground, per column of SupportShapes; empty where the
/// ground moves as one. Before the step to t_n:
struct SupportState {
  std::vector<double> displacement;  ///< r_n [m, rad]
  std::vector<double> velocity;      ///< r'_{n-1/2} [m/s, rad/s]
};

/// Motion of the supports in one step, per column of SupportShapes; empty where the ground moves as
/// one. It goes by the scheme of the structures, so that supports which all move alike give what a
/// common ground gives:
///
///     r'_{n+1/2} = r'_{n-1/2} + h r''_n,      r_{n+1} = r_n + dt r'_{n+1/2}
///
/// with h = dt, but dt / 2 in the first step.
struct SupportStep {
  std::vector<double> acceleration;     ///< r''_n [m/s2, rad/s2]
  std::vector<double> displacement;     ///< r_n [m, rad]
  std::vector<double> velocity_before;  ///< r'_{n-1/2} [m/s, rad/s]
  std::vector<double> velocity;         ///< r'_{n+1/2}
  std::vector<double> velocity_mean;    ///< of these two

  explicit SupportStep(std::size_t columns)
      : acceleration(columns, 0.0),
        displacement(columns, 0.0),
        velocity_before(columns, 0.0),
        velocity(columns, 0.0),
        velocity_mean(columns, 0.0) {}

  /// Before the step to t_n, `acceleration` being known; `duration`: h [s].
  void begin(const SupportState& state, double duration) {
    displacement = state.displacement;
    velocity_before = state.velocity;
    for (std::size_t c = 0; c < acceleration.size(); ++c) {
      velocity[c] = velocity_before[c] + duration * acceleration[c];
      velocity_mean[c] = (velocity_before[c] + velocity[c]) / 2;
    }
  }
  /// After it.
  void finish(double time_step, SupportState& state) const {
    state.velocity = velocity;
    for (std::size_t c = 0; c < velocity.size(); ++c) {
      state.displacement[c] += time_step * velocity[c];
    }
  }
};

/// Sums of interactions on one structure that a step leaves for the energy ledger, those of this
/// rank.
struct LedgerPart {
  double link_energy_before = 0;     ///< held between u_{n-1} and u_n [J]
  double link_loss = 0;              ///< taken in the step and not kept [J]
  double link_loss_before = 0;       ///< the same of the step before, of gathered rows [J]
  double damping_loss = 0;           ///< beside that of K, by beta of elements that yield [J]
  double plastic_loss = 0;           ///< taken in the step by yielding, damage and crushing [J]
  double plastic_loss_before = 0;    ///< the same of the step before, of gathered rows [J]
  double link_input = 0;             ///< work of a wave from below [J]
  double support_input = 0;          ///< work of supports' motion and loads, contacts apart [J]
  double contact_support_input = 0;  ///< of supports against contact impulses [J]
  double contact_work = 0;           ///< 1/2 lambda^T L v- of normal impulses [J]
  double friction_loss = 0;          ///< -1/2 lambda_t^T L_t (v- + v+) [J]
};

/// Displacement [m, rad] and velocity [m/s, rad/s] of some dofs before a step.
struct Before {
  explicit Before(std::size_t dofs) : displacement(dofs), velocity(dofs) {}
  std::vector<double> displacement;
  std::vector<double> velocity;
};

/// A structure in the step at hand, as interactions see and correct it; the integrator implements
/// it. Local.
class SteppedStructure {
 public:
  virtual ~SteppedStructure() = default;

  /// Over the owned dofs: u_n and v- before the free step, u_{n+1} and v+ after it [m, rad].
  virtual const std::vector<double>& displacement() const = 0;
  virtual const std::vector<double>& velocity() const = 0;
  /// Brings the state of its run up to date where the step keeps it in a batch.
  virtual void bring_state() const {}
  /// It is stepped in modes, its dashpots with it; displacement and velocity of dofs are brought
  /// where they are asked for.
  virtual bool in_modes() const { return false; }
  virtual void bring(std::span<const LocalIndex> /*dofs*/) const {}
  /// Memory of its links on this rank, which it keeps itself while it is in modes.
  virtual void take_links(std::span<double> /*memory*/) {}
  /// u_n at the known points of a trace [m, rad], where members of a batch ask for it; else empty.
  virtual std::span<const double> points(const Trace& /*trace*/) { return {}; }
  /// Dofs that `correct` may change. Allocates; before the first step. `always`: in any step; else
  /// in steps whose interaction says `corrects` alone.
  virtual void watch(std::span<const LocalIndex> dofs, bool always) = 0;
  virtual void remember(std::span<const LocalIndex> dofs, Before& before) const = 0;
  /// Forces against the motion in this step, of elements beside K u, at these dofs of
  /// LinearSystem::inelastic; in `begin`, each dof once. Uniform damping filters them with K u.
  /// `from_rest`: as if they had acted for ever, in the first step.
  virtual void act(std::span<const LocalIndex> dofs, std::span<const double> force,
                   bool from_rest) = 0;
  /// v+ = `velocity` at these dofs, which are watched; displacement and sums follow.
  virtual void correct(std::span<const LocalIndex> dofs, const Before& before,
                       std::span<const double> velocity) = 0;
};

/// The step to t_n, as all interactions share it.
struct Step {
  std::int64_t number = 0;  ///< n
  /// The interface is to be gathered whatever its distance.
  bool look_at_gap = false;
  std::span<const double> incident{};  ///< see GroundMotion::evaluate_incident [m/s]
  Profile& profile;
  const SupportStep& supports;
  std::span<SteppedStructure* const> structures;
  std::span<LedgerPart* const> ledger;  ///< per structure

  /// Forces act for half of the first step, from v_0.
  double share() const { return number == 0 ? 0.5 : 1; }
};

/// Forces between places of structures in a step of the scheme: known from u_n and, implicitly,
/// from the motion that they change. The step calls `begin` of every interaction, brings the
/// structures to v_free, calls `push` of every one in the same order, then `finish`. All methods
/// are collective over the ranks that hold the interaction's rows, which call them alike; they
/// charge their time to a phase of the profile where they act. A step allocates nothing.
class Interaction {
 public:
  virtual ~Interaction() = default;

  /// Before the first step: the dofs that it corrects.
  virtual void attach(std::span<SteppedStructure* const> structures) = 0;
  /// Elongations or gaps of u_n, the rows that act, and the state of the dofs that they move.
  virtual void begin(const Step& step) = 0;
  /// It corrects dofs in this step that are not watched always. After `begin`.
  virtual bool corrects() const { return false; }
  /// The first step in which it may act, as far as this rank knows. After `begin`.
  virtual std::int64_t next_action() const { return std::numeric_limits<std::int64_t>::max(); }
  /// v+ += M^-1 b^T lambda, lambda by its law; u_{n+1} follows.
  virtual void push(const Step& step) = 0;
  /// Adds the energies held and lost to the ledger, after every `push`.
  virtual void finish(const Step& step) = 0;

  /// Puts away, or brings back, all that the next step needs.
  virtual void keep(const StateKeeper& state) = 0;
};

/// Extremes of a recorded link, and the work it took.
struct LinkTotals {
  double largest_elongation = 0;  ///< magnitude [m, rad]
  double largest_force = 0;       ///< magnitude [N, N m]
  double work = 0;                ///< sum of N_n (e_{n+1} - e_{n-1}) / 2 [J]
  double yielded = 0;             ///< 1: it left its straight line for good
};

/// Elongation and force of chosen links in the step at hand, and their extremes and work so far.
/// Reads and changes nothing else. Local.
class LinkRecords {
 public:
  /// `links`: which ones to record, numbers among those of their owner. `push_only`: what is below
  /// zero is no elongation of theirs, the joint is open.
  void watch(std::vector<std::size_t> links, bool push_only = false);
  bool empty() const { return links_.empty(); }
  const std::vector<std::size_t>& links() const { return links_; }

  /// Link k of those chosen in the step from t_n: e_n [m, rad], N_n [N, N m].
  void note(std::size_t k, double elongation, double force, bool yielded);
  void add_work(std::size_t k, double work) { totals_[k].work += work; }

  double elongation(std::size_t k) const { return elongation_[k]; }
  double force(std::size_t k) const { return force_[k]; }
  const LinkTotals& totals(std::size_t k) const { return totals_[k]; }

  /// Under a name for each chosen link, in their order.
  void keep(const std::vector<std::string>& names, const StateKeeper& state);

 private:
  bool push_only_ = false;
  std::vector<std::size_t> links_;
  std::vector<double> elongation_;
  std::vector<double> force_;
  std::vector<LinkTotals> totals_;
};

}  // namespace pounding::interactions
