#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/types.h"
#include "mesh/force_places.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

/// Force along and moment about x, y, z [N, N m].
using Wrench = std::array<double, 6>;

/// Adds a force along, or a moment about, an axis at `x` to a wrench about `point`; `component` as
/// of dofs, 0-2 and 3-5.
inline void add_unit_force(const Vector3& point, const Vector3& x, int component, double force,
                           Wrench& wrench) {
  const auto c = static_cast<std::size_t>(component);
  wrench[c] += force;
  if (c >= 3) return;
  const std::size_t next = (c + 1) % 3;  // moment = arm x force
  const std::size_t last = (c + 2) % 3;
  wrench[3 + next] += (x[last] - point[last]) * force;
  wrench[3 + last] -= (x[next] - point[next]) * force;
}

/// Elastic forces of chosen elements of a structure, those of K_e u_e or at the centres of shells:
/// each is a linear form of the displacements of the nodes there, which in generalised coordinates
/// follow from the rows of the basis.
class ElementForces {
 public:
  /// A column of the table of all forces and the linear form that it is.
  struct Row {
    std::size_t column = 0;
    std::vector<TracePoint> points;
    std::vector<double> coefficients;  ///< per point [N/m, N, N m]
    bool grounded = false;             ///< of an element whose other end is the ground
  };

  /// The part of these rows that hangs on this rank's nodes. References must outlive this object.
  /// Local.
  ElementForces(const LinearSystem& system, const Mesh& mesh, const std::vector<Row>& rows);

  /// Adds this rank's part at displacements u_n of the owned dofs and of the supports to the
  /// columns.
  void add(std::span<const double> owned, std::span<const double> supports,
           std::span<double> columns);

 private:
  struct Term {
    std::size_t column = 0;
    std::size_t place = 0;  ///< among the known ones of the trace
    double coefficient = 0;
  };
  /// Force by which a column lessens as the ground under a grounded element moves.
  struct GroundTerm {
    std::size_t column = 0;
    std::size_t support = 0;  ///< column of SupportShapes
    double coefficient = 0;
  };
  /// Linear form of the coordinates of a reduced structure, and of the supports' motion.
  struct Form {
    std::size_t column = 0;
    std::vector<double> coordinates, supports;
  };
  /// Forms in place of terms, where they are fewer than the places.
  void take_forms();

  std::unique_ptr<Trace> trace_;
  std::vector<Form> forms_;
  std::vector<Term> terms_;
  std::vector<GroundTerm> ground_;
  std::vector<double> field_;
};

/// Names of the forces of an element, see force_rows.h.
std::span<const std::string_view> element_force_names(ElementType type);

/// Rows of the members or shells of an item, from `first` on, element after element in the item's
/// order; each element on every rank that has it. Throws UserError (an element that cannot be).
std::vector<ElementForces::Row> member_rows(const Structure& structure, const Mesh& mesh,
                                            const ResolvedForce& chosen, std::size_t first);

/// Rows of a cut, or of a total of a reduced structure, six from `first` on: minus the forces that
/// its elements exert on the counted part.
std::vector<ElementForces::Row> total_rows(const Structure& structure, const Mesh& mesh,
                                           const ForceItem& item, const ResolvedForce& passing,
                                           std::size_t first);

/// The most compressed beam or bar of a structure.
struct LargestCompression {
  double force = 0;   ///< compression above 0; 0 if there is none [N]
  std::string place;  ///< the element and its group; empty if there is none
};

/// Values of a field over the owned dofs at all local dofs, ghosts included. Collective.
std::vector<double> with_ghosts(const Mesh& mesh, const std::vector<double>& owned);

/// Gives every beam and bar of a mesh the axial force that it has under the displacements of its
/// owned dofs. Forces are rounded to a power of two of 1e-9 of the largest one, so that the
/// round-off of a solution, which differs from run to run, does not reach the stiffness. The same
/// on all ranks; collective.
LargestCompression set_axial_forces(const Structure& structure,
                                    const std::vector<double>& displacement, Mesh& mesh);

}  // namespace pounding
