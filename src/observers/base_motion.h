#pragma once

#include <functional>
#include <span>
#include <vector>

#include "dynamics/cd_lagrange.h"
#include "mesh/mesh.h"
#include "mesh/probe_set.h"
#include "system/linear_system.h"

namespace pounding {

/// This rank's part of a weighted sum of displacements of points of a structure: over owned dofs,
/// over coordinates while it is in modes, and over the motion of the supports that carries them.
class DisplacementSum {
 public:
  /// `weights`: of the points that this rank knows, in the order of `points`. References need not
  /// outlive this object. Local.
  DisplacementSum(std::size_t structure, std::span<const TracePoint> points,
                  std::span<const double> weights, const LinearSystem& system, const Mesh& mesh);

  /// Before the next step, relative to the ground [m].
  double of(const CdLagrange& stepper) const;

 private:
  std::size_t structure_;
  std::vector<LocalIndex> dofs_;
  std::vector<double> weights_;
  std::vector<double> in_modes_;  ///< weights of coordinates of a structure that may be in modes
  std::vector<double> carried_;   ///< per column of the supports' motion
};

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
  std::vector<DisplacementSum> rows_;
};

/// Means, or weighted sums, of the rows of places over probes of a structure in generalised
/// coordinates: three rows per probe, for x, y, z, shape (3 probes, values of a row). Places are
/// three components of every node, probe after probe; `row_of`: the row of a place.
std::vector<double> probe_means(
    std::span<const ResolvedProbe* const> probes,
    const std::function<std::span<const double>(std::size_t place)>& row_of);

}  // namespace pounding
