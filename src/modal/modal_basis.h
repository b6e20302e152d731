#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "modal/static_loads.h"
#include "system/linear_system.h"

namespace pounding {

/// A basis Phi of motions of a structure, u = Phi q, with Phi^T M Phi = I and Phi^T K Phi =
/// diag(omega^2), as far as a run needs it: k vectors, known at the places that are asked for.
struct ModalBasis {
  int modes = 0;                     ///< modes in it
  int attachment_vectors = 0;        ///< vectors beside them
  int residual_vectors = 0;          ///< and static responses to the motion of the ground
  std::vector<int> mode_numbers;     ///< which mode, from 1, each vector is; 0: none; shape (k)
  GlobalIndex full_dofs = 0;         ///< of the model that was reduced
  GlobalIndex independent_dofs = 0;  ///< of it, which rigid bodies and ties have fewer of
  double total_mass = 0;             ///< clamped nodes included [kg]
  double mass = 0;                   ///< of the free dofs [kg]
  Vector3 centre_of_mass{0, 0, 0};
  std::array<double, 6> inertia{};        ///< along and about x, y, z [kg, kg m2]
  std::vector<double> squared_frequency;  ///< omega^2, increasing, shape (k) [1/s2]
  std::vector<double>
      residual_squared_frequency;       ///< Rayleigh quotients of residual vectors [1/s2]
  double largest_without_residual = 0;  ///< omega^2 of the basis without them [1/s2]; 0: has none
  /// Gamma = Phi^T M R of the motions R along and about x, y, z, shape (6, k).
  std::vector<double> participation;
  std::vector<TracePoint> points;  ///< free components of nodes
  std::vector<double> rows;        ///< Phi there, shape (points, k) [kg^-1/2]
  /// Phi^T M iota of the columns of the supports' motion, shape (columns, k), and iota at the
  /// points, shape (points, columns); empty where the ground moves as one.
  std::vector<double> support_participation;
  std::vector<double> support_rows;
  /// Phi^T p of the loads on the structure, in their order, shape (its loads, k).
  std::vector<double> load_parts;
  /// Phi^T M of displacement and velocity at t = 0, shape (2, k); empty where its nodes start
  /// alike.
  std::vector<double> start_parts;

  /// Factors on the damping of elements in the mean by strain energy, shape (k): composite modal
  /// damping, sum_e d_e phi^T K_e phi / omega^2; empty: all are 1.
  std::vector<double> damping_weights;

  std::size_t size() const { return squared_frequency.size(); }

  /// Shape of an array in a file: columns of its rows, 0 of a plain vector, `each_coordinate` k;
  /// `maybe`: it is left out where it is empty.
  struct Shape {
    int columns = 0;
    bool maybe = false;
  };
  static constexpr int each_coordinate = -1;

  /// Calls `member(name, value, shape)` with all that a file of the basis and other ranks have.
  static void describe(auto& self, const auto& member) {
    member("modes", self.modes, {});
    member("attachment_vectors", self.attachment_vectors, {});
    member("residual_vectors", self.residual_vectors, {});
    member("full_dofs", self.full_dofs, {});
    member("independent_dofs", self.independent_dofs, {});
    member("largest_without_residual", self.largest_without_residual, {});
    member("total_mass", self.total_mass, {});
    member("mass", self.mass, {});
    member("squared_frequency", self.squared_frequency, {});
    member("residual_squared_frequency", self.residual_squared_frequency, {0, true});
    member("mode_numbers", self.mode_numbers, {});
    member("participation", self.participation, {each_coordinate});
    member("centre_of_mass", self.centre_of_mass, {});
    member("inertia", self.inertia, {});
    member("points", self.points, {2});
    member("rows", self.rows, {each_coordinate});
    member("load_parts", self.load_parts, {each_coordinate, true});
    member("start_parts", self.start_parts, {each_coordinate, true});
    member("support_participation", self.support_participation, {each_coordinate, true});
    member("support_rows", self.support_rows, {0, true});
    member("damping_weights", self.damping_weights, {0, true});
  }

  static void members(auto& self, auto& stream) {
    describe(self, [&](const char* /*name*/, auto& value, Shape /*shape*/) { stream(value); });
  }
};

/// The lowest modes, and beside them the attachment vectors: static responses to gravity, where the
/// run starts at rest under it, to the system's loads, and to unit forces at the contact points and
/// at those of sections that yield, so that forces there find all the flexibility (Craig and Chang,
/// AIAA J. 15 (1977), 1009; residual flexibility). With Y the modes in y = M^1/2 u and
/// A = M^-1/2 K M^-1/2,
///
///     z_j = P (A - shift)^-1 P M^-1/2 e_j,      P = I - Y Y^T
///
/// with the shift just below zero, so that free structures pass; then, where they are asked for,
/// the residual vectors, static responses to M iota of the motions of the ground, so that the mass
/// that the modes leave out is carried as a rigid one (missing mass, U.S. NRC Regulatory Guide
/// 1.92). Or, where faces have too many
/// points, to equal forces on the points of a patch (see `contact_patches`). They are made
/// orthonormal, the largest remainder first; a vector in the span to 1e-8 is dropped. Rayleigh-Ritz
/// on the whole space makes K diagonal.
///
/// Of more candidates than modes the lowest three quarters are taken, and then those that move the
/// contact points and the other points most: sum over the points of phi_k^2 / omega_k^2, each
/// relative to phi^2 of all candidates there. Along a slab runs one wave for dozens of bending
/// modes that an impact does not feel.
///
/// More modes than dofs are all modes. Modes of the same frequency as the last one come along.
/// `system` without devices, on one rank or several, which all get the basis. Throws UserError if
/// no mode lies below the cut-off. Collective.
ModalBasis compute_modal_basis(const LinearSystem& system, const Mesh& mesh,
                               const ModalRequest& request);

}  // namespace pounding
