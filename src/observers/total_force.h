#pragma once

#include <span>
#include <vector>

#include "dynamics/cd_lagrange.h"
#include "interactions/inelastic_elements.h"
#include "interactions/soil_rows.h"
#include "interactions/structure_links.h"
#include "mesh/mesh.h"
#include "scene/load.h"
#include "system/element_forces.h"
#include "system/linear_system.h"

namespace pounding {

/// The force of the ground on a structure, or the force upwards through a level of it: minus the
/// sum of all internal forces on the dofs above, those of springs, dashpots and links to the ground
/// included. Elements between counted dofs push as much as they pull, so that only those count that
/// end below the level, at clamps or in the ground. With the forces of the step to t_n,
///
///     R = - sum_i r_i ( K (u_n + beta v-) + D v- + b N )_i
///
/// r_i the force and the moment that a unit force on dof i has, or the force that uniform damping
/// filters in place of the first term. A structure that is switched has the first term in modes by
/// the forces F of its coordinates, K u = K Phi diag(omega^-2) F: r^T K Phi is found once. Exact in
/// the scheme: R is the change of momentum of the part above, less that by gravity, contacts and
/// mass damping.
class TotalForce {
 public:
  /// Finds its terms at full order; of a structure in generalised coordinates only those of links
  /// and soil. `soil`: rows between mats of all structures, of which this is number `structure`.
  /// References must outlive this object. Local.
  TotalForce(const ForceItem& item, const LinearSystem& system, const Mesh& mesh,
             std::span<const interactions::SoilRow> soil, std::size_t structure);

  /// Finds its terms in the modes of a system that is switched. Collective.
  void find_modes(const LinearSystem& system);
  /// The owned dofs whose forces are asked for: of generalised coordinates all.
  const std::vector<LocalIndex>& dofs() const { return watched_; }
  /// Adds this rank's part of R after the step to t_n of a structure; `links`: null where it has
  /// none, or where all are dashpots by which the step of a batch brakes it.
  void add(const CdLagrange& stepper, std::size_t structure,
           const interactions::StructureLinks* links,
           std::span<interactions::InelasticElements* const> inelastic,
           const interactions::SoilRows* soil, Wrench& total) const;

 private:
  /// A dof that is counted, and where it is.
  struct Counted {
    LocalIndex dof = 0;
    int component = 0;
    Vector3 place{};  ///< [m]
  };
  void add_force(const Counted& counted, double force, Wrench& total) const {
    add_unit_force(point_, counted.place, counted.component, force, total);
  }

  Vector3 point_;
  std::vector<Counted> counted_;  ///< empty in generalised coordinates
  std::vector<LocalIndex> watched_;
  /// Per coordinate of a system that is switched, this rank's part of a unit force on it.
  std::vector<Wrench> in_modes_;
  std::vector<Wrench> links_;   ///< per link of this rank, of a unit force of it
  std::vector<Wrench> soil_;    ///< per row between mats, of a unit force of it
  std::vector<Wrench> braked_;  ///< per coordinate, of v- + v+ where all links are dashpots
};

}  // namespace pounding
