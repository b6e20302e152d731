#pragma once

#include <map>
#include <optional>
#include <string>

#include "mesh/global_mesh.h"
#include "modal/modal_basis.h"
#include "scene/scene.h"

/// A modal basis in a sealed HDF5 file (output/file_seal.h), to be used again:
///
///     /                    attributes: format "pounding modal basis", version 2, program, modes,
///                          attachment_vectors, residual_vectors, full_dofs, independent_dofs,
///                          largest_without_residual [1/s2], total_mass [kg], mass [kg]
///     /residual_squared_frequency  (residual vectors) [1/s2]; left out without any
///     /squared_frequency   (k) omega^2 [1/s2]; attributes: hashes of the basis's sources
///     /mode_numbers        (k) which mode, from 1, each vector is; 0: none
///     /participation       (6, k) along and about x, y, z
///     /centre_of_mass      (3) [m]
///     /inertia             (6) [kg, kg m2]
///     /points              (n, 2) node in file order, component
///     /rows                (n, k) of the basis at the points
///     /load_parts          (l, k) Phi^T p of loads; left out without any
///     /start_parts         (2, k) Phi^T M u_0 and v_0; left out where all nodes start alike
///     /support_participation  (c, k) Phi^T M iota of the columns of the supports' motion
///     /support_rows        (n c) iota at the points; both left out where the ground moves as one
namespace pounding {

/// Hashes of the sources of a basis, by their names.
using BasisKey = std::map<std::string, std::string>;

/// Serial. Throws std::runtime_error, whose message begins with the path.
void write_modal_basis(const std::string& path, const BasisKey& key, const ModalBasis& basis);

/// Content of such a file; if it belongs to another key, no basis but the names that differ.
struct StoredBasis {
  std::optional<ModalBasis> basis;
  std::string differs;  ///< "mesh, contact points"
};

/// Serial. `request`: its loads, start and supports. Throws std::runtime_error if the file is not a
/// modal basis or damaged.
StoredBasis read_modal_basis(const std::string& path, const BasisKey& key,
                             const ModalRequest& request = {});

/// Hashes of the sources of a modal basis, by their names: mesh, materials and sections, the
/// formulations of the elements, every byte of dofs.csv and of the matrices where they come from
/// files, clamps, how many vectors, and the points where the motion is asked for. Serial. Throws
/// UserError if a file cannot be read.
BasisKey basis_key(const Structure& structure, const GlobalMesh& mesh, const ModalRequest& request);

}  // namespace pounding
