#include "interactions/delassus.h"

#include <algorithm>
#include <cstddef>

namespace pounding::interactions {

double delassus_entry(const ContactOperator& contact, const InterfaceCompliance& compliance,
                      int row, int column) {
  double sum = 0;
  const auto row_dofs = contact.row_dofs(row);
  const auto row_values = contact.row_coefficients(row);
  const auto column_dofs = contact.row_dofs(column);
  const auto column_values = contact.row_coefficients(column);
  for (std::size_t a = 0; a < row_dofs.size(); ++a) {
    for (std::size_t b = 0; b < column_dofs.size(); ++b) {
      sum += row_values[a] *
             compliance.entry(static_cast<std::size_t>(row_dofs[a]),
                              static_cast<std::size_t>(column_dofs[b])) *
             column_values[b];
    }
  }
  return sum;
}

DelassusPattern::DelassusPattern(const ContactOperator& contact,
                                 const InterfaceCompliance& compliance)
    : contact_(contact),
      compliance_(compliance),
      rows_of_(contact.dofs()),
      seen_(static_cast<std::size_t>(contact.dofs()), 0) {
  for (int row = 0; row < contact.rows(); ++row) {
    for (const int dof : contact.row_dofs(row)) rows_of_[dof].push_back(row);
  }
}

std::vector<int> DelassusPattern::coupled_with(std::span<const int> rows) {
  std::vector<int> dofs;
  const auto see = [&](int dof) {
    if (seen_[dof] == 0) dofs.push_back(dof);
    seen_[dof] = 1;
  };
  for (const int row : rows) {
    for (const int dof : contact_.row_dofs(row)) {
      see(dof);
      for (const int moved : compliance_.moved_by(static_cast<std::size_t>(dof))) see(moved);
    }
  }
  std::vector<int> coupled(rows.begin(), rows.end());
  for (const int dof : dofs) {
    coupled.insert(coupled.end(), rows_of_[dof].begin(), rows_of_[dof].end());
    seen_[dof] = 0;
  }
  std::ranges::sort(coupled);
  coupled.erase(std::unique(coupled.begin(), coupled.end()), coupled.end());
  return coupled;
}

}  // namespace pounding::interactions
