#include "contact/delassus.h"

#include <cstddef>

namespace pounding {

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

}  // namespace pounding
