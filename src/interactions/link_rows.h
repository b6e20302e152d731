#pragma once

#include <span>
#include <vector>

#include "interactions/solvers/law_solver.h"
#include "interactions/structure_links.h"
#include "interactions/yield_groups.h"

namespace pounding::interactions {

/// Elongation of each link of a system per unit of each column of the supports' motion; empty where
/// no link is stretched by it. Local.
std::vector<std::vector<double>> carried_by_supports(const LinearSystem& system);

/// Links of a structure row by row: once the step without them is made, their forces are solved for
/// (LawSolver) and v+ and u_{n+1} corrected at the dofs that they move. Contact comes after them;
/// where it acts on the nodes of a dashpot, or of a link that switches in the same step, the link's
/// work differs from that of its law by the part that contact changed, and the ledger shows it as
/// loss. Local.
class LinkRows final : public StructureLinks {
 public:
  LinkRows(const LinearSystem& system, std::size_t structure, double time_step);

  void begin(const Step& step) override;
  void push(const Step& step) override;
  void finish(const Step& step) override;
  void load(const SavedState& saved) override;
  Bedding bedding() const override;
  bool overpressed() const override;
  double force(std::size_t link) const override { return force_[link]; }

 private:
  LawSolver make_solver(const LinearSystem& system);
  std::vector<OnBody> find_bodies(const LinearSystem& system) const;
  std::vector<std::vector<Coupling>> find_couplings(const std::vector<OnBody>& on_body,
                                                    std::size_t owned_dofs);
  /// b . v of all links for impulses [N s] of one of them in a second [1/kg].
  void respond(const Link& link, std::vector<double>& all, std::vector<double>& response);
  /// b . u of all links, with the supports' motion that carries them along, per column.
  void measure_carried(const std::vector<double>& owned, std::span<const double> supports,
                       std::vector<double>& elongations);

  std::vector<std::vector<double>> carried_;  ///< see carried_by_supports
  LawSolver solver_;
  YieldGroups yields_;
  std::vector<char> has_rate_;         ///< per link
  std::vector<std::size_t> in_waves_;  ///< links that a wave from below drives
  bool rates_only_ = false;            ///< every link has one
  bool rates_known_ = false;           ///< rate_ is that of v-
  Elongations elongations_;
  std::vector<double> after_;    ///< e_{n+1}
  std::vector<double> rate_;     ///< b . v
  std::vector<double> driven_;   ///< of the wave from below, against N_n [N]
  std::vector<double> force_;    ///< N_n [N]
  std::vector<double> stretch_;  ///< (e_{n+1} - e_{n-1}) / 2
};

}  // namespace pounding::interactions
