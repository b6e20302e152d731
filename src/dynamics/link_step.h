#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/saved_state.h"
#include "dynamics/dashpot_modes.h"
#include "dynamics/link_records.h"
#include "dynamics/state.h"
#include "dynamics/step_sums.h"
#include "dynamics/structure_step.h"
#include "dynamics/support_step.h"
#include "interactions/laws/link_law.h"
#include "system/links.h"
#include "system/trace.h"

namespace pounding {

/// Links' part of a step of their structure, on the rank that owns their nodes: once the step
/// without them is made, their forces are solved for (LinkLaw; dashpots that move each other
/// directly, other links by Gauss-Seidel sweeps, which converge since no force falls as its
/// elongation grows; dashpots alone in generalised coordinates by DashpotModes) and v+ and u_{n+1}
/// corrected at the dofs that they move. Contact comes after
/// them; where it acts on the nodes of a dashpot, or of a link that switches in the same step, the
/// link's work differs from what its law tells by what contact changed, and the ledger shows it as
/// loss. Local.
class LinkStep {
 public:
  /// `system` has links. References must outlive this object.
  LinkStep(const LinearSystem& system, const StructureState& state, StructureStep& step,
           const SupportStep& supports, double time_step);

  /// Before the structure's step to t_n: e_n, e_{n-1}, and what the dofs hold. `incident`: velocity
  /// of the wave from below at t_n [m/s].
  void begin(const Vector3& incident);
  /// After it: forces, v+, u_{n+1}. `first`: they act for half a step, from v_0.
  void pull(bool first);
  /// After contact: adds the links' energy before the step and their loss in it; they remember it.
  void finish(StepSums& sums);

  /// Stiffness of this rank's compression-only springs [N/m]: of those that are pressed at the end
  /// of the step, and of all.
  struct Bedding {
    double pressed = 0;
    double all = 0;
  };
  Bedding bedding() const;

  /// Records some of this rank's links from now on, numbers into `links()` of the system.
  void record(std::vector<std::size_t> links);
  /// A pendulum of this rank was pressed beyond the slope that its stiffness allows.
  bool overpressed() const;
  const LinkRecords& records() const { return records_; }
  /// Force N_n of a link of this rank in the step just made [N, N m].
  double force(std::size_t link) const;

  /// Saves what the links remember, link by link. `structure`: its number.
  void save(int structure, SavedState& saved) const;
  void load(int structure, const SavedState& saved);

 private:
  struct Coupling {
    std::size_t link = 0;
    double compliance = 0;  ///< dt^2 b_i^T M^-1 b_j [m/N]
  };
  /// Part of a link in the motions of one rigid body that alone it moves: W^T b. Such links move
  /// each other by products of these, so that many of them cost no more than a few each.
  using Motion = std::array<double, RigidBody::width>;
  struct OnBody {
    int body = -1;  ///< -1: it moves something else
    Motion motion{};
  };
  /// Links with a rate that move each other, solved for together.
  struct Block {
    int body = -1;  ///< all on this one: solved for by its motions
    std::vector<std::size_t> links;
    std::vector<double> compliance;  ///< dt^2 B^T M^-1 B, shape (links, links) [m/N]
    std::vector<double> inverse;     ///< of that for `share_` of a step and 1 / rate [N/m]; on a
                                     ///< body that of 1 / (share dt^2) + B^T W rate W^T B
    std::vector<double> free;        ///< e_{n+1} - e_{n-1} without them
    std::vector<double> force;
  };
  /// Links that yield together, mostly one.
  struct Yielding {
    std::vector<std::size_t> links;
    int gauge = -1;       ///< link that tells what presses on a sliding bearing; -1: none
    double friction = 0;  ///< of such a bearing: capacity over minus the gauge's elongation [N/m]
    double pressing = 0;  ///< likewise what presses on it [N/m]
  };
  /// All that there is are dashpots of a structure in generalised coordinates.
  bool are_dashpots(const LinearSystem& system) const;
  void make_modes(const LinearSystem& system);
  /// `pull` and `finish` of these.
  void brake(bool first);
  void finish_modes(StepSums& sums);
  void find_carried();
  void find_yielding();
  /// Yields from e_n, before any force of the step is known.
  void yield();
  void find_bodies(const LinearSystem& system);
  void find_couplings();
  void find_blocks();
  void fill_block(Block& block, const std::vector<std::size_t>& place);
  void form_inverses(double share);
  /// Their forces from those of the other links.
  void solve(Block& block);
  /// e of all links that impulses [N s] of one of them cause in a second [m/N s2].
  void respond(const Link& link);
  void solve_on_body(Block& block);
  /// Brings block_pull_ to the forces of a block.
  void renew_pull(const Block& block);
  /// Largest change of the force of a link without a rate [N].
  double sweep();
  /// e_{n+1} that forces of others than its block leave a link.
  double left_over(std::size_t link) const;
  double largest_force() const;
  void note_records();
  /// b . u of all links; `supports`: motion that carries them along, per column.
  void measure(const std::vector<double>& owned, std::span<const double> supports,
               std::vector<double>& elongations);
  /// e_n + duration b . v.
  void add_rates(double duration, std::vector<double>& elongations) const;

  const StructureState& state_;
  StructureStep& step_;
  const SupportStep& supports_;
  double time_step_;
  const std::vector<Link>& links_;
  Trace trace_;
  StructureStep::Before held_;
  std::vector<std::unique_ptr<interactions::LinkLaw>> laws_;  ///< per link
  std::vector<std::vector<double>> memory_;                   ///< per link; see LinkLaw
  std::vector<OnBody> on_body_;                               ///< per link
  std::unique_ptr<DashpotModes> modes_;                       ///< null: link by link
  std::vector<Motion> pull_;        ///< per body: sum of W^T b N of links without a rate on it
  std::vector<Motion> block_pull_;  ///< likewise of those with a rate
  /// Per link: itself first, none of its block, none on the same body.
  std::vector<std::vector<Coupling>> coupled_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> others_;  ///< links without a rate
  std::vector<Yielding> yielding_;
  double share_ = 0;                ///< of a step, for which forces act
  bool rates_known_ = false;        ///< rate_ is that of v-
  std::vector<double> before_;      ///< e_{n-1} [m]
  std::vector<double> now_;         ///< e_n; 0 of laws with a rate
  std::vector<double> after_;       ///< e_{n+1}
  std::vector<double> free_after_;  ///< e_{n+1} without any link
  std::vector<double> force_;       ///< N_n [N]
  std::vector<double> push_;        ///< of the wave from below, against N_n [N]
  std::vector<double> field_;       ///< per place of the trace
  std::vector<double> velocity_;    ///< per dof of the trace
  std::vector<double> rate_;        ///< b . v
  LinkRecords records_;
  std::vector<double> recorded_;  ///< e_n of all links; empty if none is recorded
  /// Elongation of each link per unit of each column of the supports' motion; empty without.
  std::vector<std::vector<double>> carried_;
};

}  // namespace pounding
