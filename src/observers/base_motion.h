#pragma once

#include <functional>
#include <span>
#include <vector>

#include "dynamics/cd_lagrange.h"
#include "mesh/mesh.h"
#include "mesh/probe_set.h"
#include "system/linear_system.h"
#include "system/trace.h"

namespace pounding {

/// Mean displacements of the supports of structures, where these move. Each rank has its part of a
/// mean, so that bases of many nodes cost a record three numbers.
class BaseMotion {
 public:
  BaseMotion() = default;
  /// `bases`: their nodes. References need not outlive this object. Local.
  BaseMotion(std::span<const ResolvedProbe> bases, std::span<const LinearSystem> systems,
             std::span<const Mesh> meshes);

  /// Three per base.
  std::size_t values() const { return rows_.size(); }
  /// This rank's part of the displacements, relative to the ground, shape (bases, 3) [m].
  void put(const CdLagrange& stepper, double* out) const;

 private:
  /// A component of a mean: a sum over owned dofs and over the motion of the supports.
  struct Row {
    std::size_t structure = 0;
    std::vector<LocalIndex> dofs;
    std::vector<double> weights;
    std::vector<double> in_modes;  ///< weights of coordinates of a structure that may be in modes
    std::vector<double> carried;   ///< per column of the supports' motion
  };
  std::vector<Row> rows_;
};

/// Means, or weighted sums, of the rows of places over probes of a structure in generalised
/// coordinates: three rows per probe, for x, y, z, shape (3 probes, values of a row). Places are
/// three components of every node, probe after probe; `row_of`: the row of a place.
std::vector<double> probe_means(
    std::span<const ResolvedProbe* const> probes,
    const std::function<std::span<const double>(std::size_t place)>& row_of);

}  // namespace pounding
