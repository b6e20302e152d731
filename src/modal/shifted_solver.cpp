#include "modal/shifted_solver.h"

#include <cmath>
#include <map>
#include <optional>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "elements/geometric_stiffness.h"
#include "mesh/element_properties.h"
#include "modal/eigen_solver.h"
#include "stiffness/element_loop.h"
#include "system/admissible_motions.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

/// Another owner of a matrix.
MatHandle reference_to(Mat matrix) {
  POUNDING_PETSC(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
  MatHandle reference;
  *reference.out() = matrix;
  return reference;
}

/// Part of the largest eigenvalue by which round-off may put one below zero.
constexpr double round_off_share = 1e-11;

void require_semidefinite(const LinearSystem& system, Mat matrix, const std::string& path) {
  const MatHandle scaled = mass_scaled(system, matrix);
  double bound = 0;  // of the largest eigenvalue, by Gershgorin
  POUNDING_PETSC(MatNorm(scaled.get(), NORM_INFINITY, &bound));
  if (bound == 0) return;
  const int negative = ShiftedSolver(scaled.get(), -round_off_share * bound).eigenvalues_below();
  refuse_if(negative > 0,
            path + ": not positive semidefinite, " + std::to_string(negative) +
                " of its eigenvalues lie below zero: some motion would give energy; look for "
                "entries with the wrong sign, or rows and columns left out");
}

/// Eigenvalue of the stiffness, scaled to a unit diagonal, by which round-off may put one below
/// zero.
constexpr double zero_eigenvalue = 1e-13;
constexpr int iterations = 60;

/// Work of the axial forces in a motion, phi^T K_G phi, by group [J]. Collective.
std::map<std::string, double> works_of(const Structure& structure, const Mesh& mesh,
                                       const std::vector<double>& motion) {
  const std::vector<double> values = with_ghosts(mesh, motion);
  std::map<std::string, double> works;
  stiffness::ElementWork work;
  for (const ElementBlock& block : mesh.blocks) {
    if (!has_axial_force(block.type)) continue;
    const ElementProperties properties = element_properties(structure.regions[block.region]);
    const auto size = static_cast<std::size_t>(element_layout(block.type).size());
    double sum = 0;
    for (std::size_t e = 0; e < block.count(); ++e) {
      if (block.counted[e] == 0) continue;
      const std::span<double> matrix(work.stiffness.data(), size * size);
      std::fill(matrix.begin(), matrix.end(), 0.0);
      add_geometric_stiffness(block.type, gather_coordinates(mesh, block, e, work), properties,
                              block.axial_force[e], matrix);
      const stiffness::ElementDofs dofs(mesh, block, e);
      for (std::size_t i = 0; i < size; ++i) {
        for (std::size_t j = 0; j < size && dofs[i] >= 0; ++j) {
          if (dofs[j] >= 0) sum += values[dofs[i]] * matrix[i * size + j] * values[dofs[j]];
        }
      }
    }
    reduce_over_ranks(mesh.comm, MPI_SUM, sum);
    works[block.group] += sum;
  }
  return works;
}

/// 1 / sqrt(|A_ii|) over the owned rows; 1 where A_ii is zero.
std::vector<double> inverse_roots(const LinearSystem& system, Mat matrix) {
  std::vector<double> roots(system.lumped_mass.size());
  const VecHandle diagonal = wrap_vector(system, roots);
  POUNDING_PETSC(MatGetDiagonal(matrix, diagonal.get()));
  for (double& root : roots) root = root != 0 ? 1 / std::sqrt(std::abs(root)) : 1;
  return roots;
}

/// Motion of the lowest eigenvalue, in coordinates of the matrix. Collective.
std::vector<double> lowest_vector(const LinearSystem& system, Mat matrix) {
  double shift = -zero_eigenvalue;
  while (ShiftedSolver(matrix, shift).eigenvalues_below() > 0) shift *= 10;
  const ShiftedSolver solver(matrix, shift);
  std::vector<double> x(system.lumped_mass.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(12.9898 * static_cast<double>(i) + 1);
  for (int k = 0; k < iterations; ++k) {
    solver.solve(x);
    double square = 0;
    for (const double value : x) square += value * value;
    reduce_over_ranks(system.comm, MPI_SUM, square);
    for (double& value : x) value /= std::sqrt(square);
  }
  return x;
}

}  // namespace

ShiftedSolver::ShiftedSolver(Mat matrix, double shift)
    : matrix_(reference_to(matrix)), shift_(shift), factor_(matrix, shift) {}

void require_passive_matrices(const Structure& structure, const LinearSystem& system) {
  if (structure.matrices.empty()) return;
  require_semidefinite(system, system.stiffness->matrix(),
                       matrix_file(structure.matrices, "stiffness"));
  if (system.extra_damping) {
    require_semidefinite(system, system.extra_damping->matrix(),
                         matrix_file(structure.matrices, "damping"));
  }
}

void require_no_buckling(const Structure& structure, const Mesh& mesh, const LinearSystem& system,
                         const LargestCompression& largest) {
  std::optional<AdmissibleMotions> admissible;
  MatHandle matrix;
  if (system.rigid_bodies.empty()) {
    POUNDING_PETSC(MatDuplicate(system.stiffest_matrix(), MAT_COPY_VALUES, matrix.out()));
  } else {
    admissible.emplace(system, AdmissibleMotions::Alone::as_is);
    matrix = admissible->restrict_matrix(system.stiffest_matrix());
  }
  std::vector<double> scale = inverse_roots(system, matrix.get());
  const VecHandle diagonal = wrap_vector(system, scale);
  POUNDING_PETSC(MatDiagonalScale(matrix.get(), diagonal.get(), diagonal.get()));
  POUNDING_PETSC(MatSetOption(matrix.get(), MAT_SYMMETRIC, PETSC_TRUE));
  if (ShiftedSolver(matrix.get(), -zero_eigenvalue).eigenvalues_below() == 0) return;
  std::vector<double> motion = lowest_vector(system, matrix.get());
  for (std::size_t i = 0; i < motion.size(); ++i) motion[i] *= scale[i];
  if (admissible) admissible->to_motion(motion);
  std::string group;
  double least = 0;
  for (const auto& [name, work] : works_of(structure, mesh, motion)) {
    if (work < least) group = name;
    least = std::min(least, work);
  }
  throw UserError(
      sentence("option -{}_p_delta: structure {} buckles under its weight and loads, by the axial "
               "forces of group {}; up to {} N press {}; give it stiffer sections or less to carry",
               {structure.name, structure.name, group, largest.force, largest.place}));
}

}  // namespace pounding
