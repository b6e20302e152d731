#pragma once

#include <cstddef>
#include <vector>

#include "mesh/mesh.h"
#include "system/mass_scaling.h"

namespace pounding {

/// Cost of the steps of a structure by the step that its mass is scaled for: of fewer steps, each
/// of which solves for the mass of more nodes. From the steps that single elements allow and the
/// costs of measured_costs.h.
class StepCosts {
 public:
  /// `mesh` must outlive this object.
  explicit StepCosts(const Mesh& mesh);

  /// Every element of this rank, with the step that it allows by itself [s], infinite where it
  /// limits none.
  void add(const ElementBlock& block, std::size_t element, double step);

  /// Step, `most` [s] at most, at which an earthquake costs least, the cost of such a step and the
  /// share of coupled dofs, after every element; 0 where none costs less than the present one.
  /// Collective.
  ScalingOffer cheapest(double most) const;

 private:
  const Mesh& mesh_;
  double shortest_;                ///< step of all elements [s]
  double longest_;                 ///< that elements without scaled mass allow [s]
  double plain_ = 0;               ///< cost of a step without scaled mass
  std::vector<double> steps_;      ///< of shells and solids [s]
  std::vector<double> node_step_;  ///< from which an element at each owned node is scaled [s]
  std::vector<double> node_cost_;  ///< of its part in a solution, by that element
};

}  // namespace pounding
