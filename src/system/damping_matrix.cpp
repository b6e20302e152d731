#include "system/damping_matrix.h"

#include <algorithm>
#include <array>

#include "elements/element_traits.h"
#include "laws/law_of.h"
#include "mesh/element_properties.h"
#include "stiffness/element_loop.h"
#include "stiffness/stiffness.h"

namespace pounding {
namespace {

/// The dashpots of all springs and bars.
MatHandle dashpot_matrix(const Structure& structure, const Mesh& mesh) {
  const auto has_dashpots = [&](const ElementBlock& block) {
    return (is_spring(block.type) || is_bar(block.type)) &&
           interactions::has_links(structure.regions[block.region]);
  };
  if (std::ranges::none_of(mesh.blocks, has_dashpots)) return {};
  MatHandle matrix = stiffness::create_matrix(mesh, has_dashpots);
  const std::vector<PetscInt> numbers = stiffness::global_numbers(mesh);
  stiffness::ElementWork work;
  std::array<double, max_element_size * max_element_size> values{};
  for (const ElementBlock& block : mesh.blocks) {
    if (!has_dashpots(block)) continue;
    const ElementLayout layout = element_layout(block.type);
    const std::size_t size = layout.size();
    for (std::size_t e = 0; e < block.count(); ++e) {
      element_dashpots(block.type, stiffness::gather_coordinates(mesh, block, e, work),
                       element_properties(structure.regions[block.region], block.share_of(e)),
                       {values.data(), size * size});
      const auto dofs = stiffness::element_dofs(mesh, block, e, layout);
      std::array<PetscInt, max_element_size> rows{};
      std::array<PetscInt, max_element_size> columns{};
      for (std::size_t i = 0; i < size; ++i) {
        columns[i] = dofs[i] >= 0 ? numbers[dofs[i]] : -1;
        rows[i] = dofs[i] < mesh.owned_dofs ? columns[i] : -1;
      }
      const auto n = static_cast<PetscInt>(size);
      POUNDING_PETSC(
          MatSetValues(matrix.get(), n, rows.data(), n, columns.data(), values.data(), ADD_VALUES));
    }
  }
  POUNDING_PETSC(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
  POUNDING_PETSC(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
  return matrix;
}

}  // namespace

MatHandle damping_matrix(const Structure& structure, const Mesh& mesh, const LinearSystem& system) {
  MatHandle dashpots = dashpot_matrix(structure, mesh);
  const Mat extra = system.extra_damping ? system.extra_damping->matrix() : nullptr;
  if (extra == nullptr) return dashpots;
  MatHandle sum;
  POUNDING_PETSC(MatDuplicate(extra, MAT_COPY_VALUES, sum.out()));
  if (dashpots.get() != nullptr) {
    POUNDING_PETSC(MatAXPY(sum.get(), 1, dashpots.get(), DIFFERENT_NONZERO_PATTERN));
  }
  return sum;
}

}  // namespace pounding
