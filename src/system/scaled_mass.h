#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "elements/element_traits.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/block_factorisation.h"
#include "system/linear_system.h"

namespace pounding {

/// Collects the mass S that the stiff elements of a structure are given (see mass_scaling.h),
/// element by element in the order of the mesh, and leaves M + S factorised, with the structure's
/// rigid bodies, ties and the water that it holds.
class ScaledMass {
 public:
  ScaledMass(const Structure& structure, const Mesh& mesh) : structure_(structure), mesh_(mesh) {}

  /// Returns the factor c of the element [s2], 0 if it is not scaled, from its stiffness of shape
  /// (n, n) and its lumped mass of shape (n). Throws std::logic_error if its nodes live on several
  /// ranks; see `coupled_nodes`.
  double add(const ElementBlock& block, std::size_t element, const Region& region,
             std::span<const double> stiffness, std::span<const double> mass);
  /// Fills in the data of `system` on this rank; its lumped mass is complete.
  void finish(LinearSystem& system);
  /// LinearSystem::mass_scaling and rigid_bodies over all ranks. Collective.
  void share(LinearSystem& system) const;

 private:
  /// The ties of this rank; adds a report of every tie of the structure.
  std::vector<TiedPart> make_ties(std::span<const double> lumped_mass);
  void add_blocks(const ElementBlock& block, std::size_t element);
  void add_rows(const ElementBlock& block, std::size_t element, std::span<const double> stiffness);

  const Structure& structure_;
  const Mesh& mesh_;
  MassScaling report_;
  std::vector<RigidBodyReport> bodies_;
  std::map<std::array<LocalIndex, 2>, NodeBlock> blocks_;  ///< by local nodes, row >= column
  std::map<LocalIndex, double> row_sums_;                  ///< of |K_e| per dof
  std::array<double, max_element_size * max_element_size> added_{};
};

}  // namespace pounding
