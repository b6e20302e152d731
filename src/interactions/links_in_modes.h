#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "interactions/dashpot_modes.h"
#include "laws/law_of.h"
#include "solvers/law_solver.h"
#include "system/linear_system.h"

namespace pounding::interactions {

/// The links of all ranks of a structure, one rank after the other, over generalised coordinates.
struct AllLinks {
  std::vector<LinkOrigin> origins;  ///< with regions of the scene
  std::vector<double> rows;         ///< B, shape (links, coordinates)
};

/// The links of a structure in modes, those of all ranks on every one, for whole steps. Each pulls
/// by its rate and by an offset that follows from its memory (LinkLaw),
///
///     N = r (e_{n+1} - e_{n-1}) + o
///
/// so that once the offsets have pushed the coordinates, the rates brake them together as dashpots
/// c = 2 dt r do (DashpotBrake). At full order they are those of the rank (StructureLinks), whose
/// memory goes from the one to the other.
class LinksInModes {
 public:
  /// `system`: at full order; `modes`: the coordinates, of which every rank has all. References
  /// must outlive this object. Collective.
  LinksInModes(const LinearSystem& system, const LinearSystem& modes, const AllLinks& links,
               double time_step);

  bool empty() const { return laws_.empty(); }
  /// Memory of the links of this rank at full order, which must outlive this object.
  void take(std::span<double> memory) { own_memory_ = memory; }
  /// Brings memories from full order to all ranks, and back. The first is collective.
  void gather();
  void give_back() const;

  /// v+ of all coordinates out of v_free; `before`: v-. Local.
  void push(std::span<const double> before, std::span<double> velocity);
  double energy() const { return energy_; }  ///< held before that step [J]
  double loss() const { return loss_; }      ///< in it [J]
  /// N of a link of this rank in it [N, N m].
  double force(std::size_t link) const;
  /// Energy that links hold at velocities of the coordinates; those of this rank at velocities over
  /// its owned dofs [J].
  double energy_in_modes(std::span<const double> velocity) const;
  double energy_of_own(std::span<const double> velocity) const;

 private:
  /// b . v of a link.
  double rate(std::size_t link, std::span<const double> velocity) const;
  /// Energy that a link holds with a rate [J].
  double held(std::size_t link, double rate) const;

  const LinearSystem& system_;
  const LinearSystem& modes_;
  const std::vector<double>& rows_;
  double time_step_;
  std::vector<std::unique_ptr<LinkLaw>> laws_;
  LawMemory memory_;
  std::vector<std::size_t> mindful_;  ///< links that are more than a dashpot
  std::vector<double> strengths_;     ///< 2 dt r of each link [N s/m, N m s]
  std::optional<DashpotBrake<double>> brake_;
  std::size_t first_ = 0;         ///< number of this rank's first link
  std::span<double> own_memory_;  ///< of this rank's links
  std::vector<double> offset_;    ///< o of each link in the step
  std::vector<double> rate_;      ///< b . v- of the mindful
  double energy_ = 0;
  double loss_ = 0;
};

}  // namespace pounding::interactions
