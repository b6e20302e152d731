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
    const std::size_t size = element_layout(block.type).size();
    for (std::size_t e = 0; e < block.count(); ++e) {
      element_dashpots(block.type, stiffness::gather_coordinates(mesh, block, e, work),
                       element_properties(structure.regions[block.region], block.share_of(e)),
                       {values.data(), size * size});
      stiffness::add_element(mesh, numbers, stiffness::ElementDofs(mesh, block, e), values.data(),
                             matrix.get());
    }
  }
  assemble(matrix.get());
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
