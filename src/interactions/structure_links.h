#pragma once

#include <memory>
#include <span>
#include <vector>

#include "interactions/interaction.h"
#include "laws/link_law.h"
#include "solvers/law_solver.h"
#include "solvers/sparse_rows.h"
#include "system/linear_system.h"
#include "system/links.h"
#include "system/trace.h"

namespace pounding::interactions {

/// Links of one structure in a step, on the rank that owns their nodes. Local.
class StructureLinks : public Interaction {
 public:
  void attach(std::span<SteppedStructure* const> structures) override;
  void keep(const StateKeeper& state) override;

  /// Stiffness of this rank's compression-only springs [N/m]: of those that are pressed at the end
  /// of the step, and of all.
  struct Bedding {
    double pressed = 0;
    double all = 0;
  };
  virtual Bedding bedding() const { return {}; }
  /// A pendulum of this rank was pressed beyond the slope that its stiffness allows.
  virtual bool overpressed() const { return false; }
  /// Force N_n of a link of this rank in the step just made [N, N m].
  virtual double force(std::size_t link) const = 0;
  /// Records some of this rank's links from now on, numbers into `links()` of the system.
  void record(std::vector<std::size_t> links);
  const LinkRecords& records() const { return records_; }

 protected:
  StructureLinks(const LinearSystem& system, std::size_t structure, double time_step);

  /// b . u of all links from values over the owned dofs.
  void measure(const std::vector<double>& owned, std::vector<double>& elongations);
  /// Notes them with the forces and the work of the step.
  void note_records(std::span<const double> now, std::span<const double> stretch,
                    std::span<const double> force);

  std::size_t structure_;
  double time_step_;
  const std::vector<Link>& links_;
  SparseRows weights_;  ///< b of each link over the points of the trace, shape (links, points)
  Trace trace_;
  std::vector<std::unique_ptr<LinkLaw>> laws_;  ///< per link
  LawMemory memory_;
  Before held_;
  std::vector<double> field_;     ///< per point of the trace
  std::vector<double> velocity_;  ///< per dof of the trace
  LinkRecords records_;
  std::vector<double> recorded_;  ///< e_n of all links; empty if none is recorded
};

/// Links of a structure that yield on a circle: two components of a bearing together, by the
/// resultant of their trials, those of a sliding one at a capacity that follows from the force on
/// it. Local.
class YieldGroups {
 public:
  explicit YieldGroups(std::span<const Link> links);

  /// Yields from e_n, before any force of the step is known.
  void yield(std::span<const std::unique_ptr<LinkLaw>> laws, std::span<const double> now,
             LawMemory& memory) const;

 private:
  struct Group {
    std::vector<std::size_t> links;
    int gauge = -1;       ///< link whose force presses a sliding bearing; -1: none
    double friction = 0;  ///< of such a bearing: capacity over minus the gauge's elongation [N/m]
    double pressing = 0;  ///< force that presses on it, over the same [N/m]
  };
  std::vector<Group> groups_;
};

/// Elongation of each link of a system per unit of each column of the supports' motion; empty where
/// no link is stretched by it. Local.
std::vector<std::vector<double>> carried_by_supports(const LinearSystem& system);

}  // namespace pounding::interactions
