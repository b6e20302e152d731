#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/profile.h"
#include "common/saved_state.h"
#include "common/types.h"
#include "interactions/ledger_part.h"
#include "interactions/support_step.h"
#include "system/trace.h"

namespace pounding::interactions {

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
  /// Brings the state of its run up to date where the step keeps it in lanes.
  virtual void bring_state() const {}
  /// u_n at the known places of a trace [m, rad], where runs in lanes all ask for it; else empty.
  virtual std::span<const double> places(const Trace& /*trace*/) { return {}; }
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
  Vector3 incident{};  ///< velocity of the wave from below [m/s]
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
  /// v+ += M^-1 b^T lambda, lambda by its law; u_{n+1} follows.
  virtual void push(const Step& step) = 0;
  /// Adds the energies held and lost to the ledger, after every `push`.
  virtual void finish(const Step& step) = 0;

  virtual void save(SavedState& saved) const = 0;
  virtual void load(const SavedState& saved) = 0;
};

}  // namespace pounding::interactions
