#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/mesh.h"
#include "scene/scene.h"
#include "system/linear_system.h"

namespace pounding {

/// Bounds of the whole from single elements: the largest omega of an element bounds omega_max from
/// above, and the smallest stable time step of an element bounds that of the structure from below:
///
///     x^T (4 M - 2 dt C - dt^2 K) x  =  sum over elements e of x^T (4 M_e - 2 dt C_e - dt^2 K_e) x
///
/// with C_e = alpha M_e + beta K_e of the element's region. Springs have no mass: by Gershgorin,
/// theirs are at most diagonal matrices of the sums of their |C_ij| and |K_ij| over each row, which
/// the elements with mass carry in proportion to the mass that they give to the row. Elements with
/// scaled mass allow the step that it is for, and have the frequencies of it.
class ElementBounds {
 public:
  ElementBounds(const Structure& structure, const Mesh& mesh)
      : structure_(structure), mesh_(mesh), stiffening_(structure.stiffening()) {}

  /// Every element of this rank in the order of the mesh: stiffness of shape (n, n), lumped mass
  /// and local dofs (-1: none) of shape (n); its mass scaling factor c [s2].
  void add(const ElementBlock& block, std::span<const double> stiffness,
           std::span<const double> mass, std::span<const LocalIndex> dofs, double mass_scaling);

  /// After every element, with the lumped mass complete: fills in the bounds of `system` and its
  /// slivers. Collective.
  void finish(LinearSystem& system);

 private:
  /// Elements of one shape have one frequency: look at one of them.
  double frequency(std::span<const double> stiffness, std::span<const double> mass);
  /// Time step of an element without the springs at its nodes [s]; infinite without mass.
  double time_step_alone(const ElementBlock& block, double frequency, double mass_scaling) const;
  double time_step(const ElementBlock& block, std::size_t element, double frequency,
                   double mass_scaling, std::span<const double> lumped_mass) const;
  Rayleigh damping_of(const ElementBlock& block) const;
  /// The offer to scale mass, from the steps that the elements of each block allow by themselves.
  /// Collective.
  ScalingOffer find_offer(const std::vector<std::vector<double>>& alone) const;

  const Structure& structure_;
  const Mesh& mesh_;
  const double stiffening_;                        ///< of the structure, which iterates for it
  std::unordered_map<std::string, double> known_;  ///< frequency by shape
  std::vector<double> frequencies_;       ///< per element [rad/s]; infinite without mass, -infinite
                                          ///< without stiffness as well
  std::vector<double> mass_scaling_;      ///< c per element [s2]
  std::vector<double> device_damping_;    ///< row sums over elements without mass [N s/m]
  std::vector<double> device_stiffness_;  ///< row sums over elements without mass [N/m]
};

}  // namespace pounding
