#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/force_places.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

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
  std::unique_ptr<Trace> trace_;
  std::vector<Term> terms_;
  std::vector<GroundTerm> ground_;
  std::vector<double> field_;
};

/// Names of the forces of an element, of shell_forces.h or end_forces.h.
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

}  // namespace pounding
