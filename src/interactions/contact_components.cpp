#include "interactions/contact_components.h"

#include <stdexcept>
#include <string>

#include "common/disjoint_sets.h"

namespace pounding::interactions {

std::vector<std::vector<int>> coupled_components(std::span<const std::vector<int>> row_dofs,
                                                 int number_of_dofs) {
  const std::size_t rows = row_dofs.size();
  DisjointSets sets(rows);
  std::vector<int> first_row_on_dof(number_of_dofs, -1);
  for (std::size_t r = 0; r < rows; ++r) {
    const int row = static_cast<int>(r);
    for (const int dof : row_dofs[r]) {
      if (dof < 0 || dof >= number_of_dofs) {
        throw std::invalid_argument("coupled_components: dof " + std::to_string(dof) + " of row " +
                                    std::to_string(row) + " is not below " +
                                    std::to_string(number_of_dofs));
      }
      int& seen = first_row_on_dof[dof];
      if (seen < 0) {
        seen = row;
        continue;
      }
      sets.join(r, static_cast<std::size_t>(seen));
    }
  }

  std::vector<std::vector<int>> groups;
  std::vector<std::size_t> group_of(rows);  // of the first row of each group
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t first = sets.root(r);
    if (first == r) {
      group_of[r] = groups.size();
      groups.emplace_back();
    }
    groups[group_of[first]].push_back(static_cast<int>(r));
  }
  return groups;
}

}  // namespace pounding::interactions
