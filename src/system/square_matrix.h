#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/matrix_market.h"

namespace pounding {

/// Rows of a square matrix out of a file, those of this rank's dofs, with the numbers needed to
/// check them; rows and columns are numbered as in the file, from 0.
class SquareMatrix {
 public:
  using Entry = std::pair<PetscInt, double>;  ///< column, value

  /// Per row of the file: `owned_dof`, the dof of this rank that it is, or -1; `number`, the global
  /// dof, or -1 if it is clamped, whose row and column are left out. Both must outlive this object.
  SquareMatrix(std::string path, const std::vector<PetscInt>& owned_dof,
               const std::vector<PetscInt>& number, std::size_t owned_dofs);

  /// An entry of the file; several at one place add up.
  void add(const MatrixEntry& entry);
  /// After the last entry.
  void finish();

  /// Throws UserError naming file, row and column where the diagonal is negative, where K_ij and
  /// K_ji differ by more than 1e-9 of the largest entry, or where K_ij^2 > K_ii K_jj: a matrix that
  /// is symmetric and has no negative eigenvalue passes.
  void check() const;

  /// Per owned dof its entries by column.
  const std::vector<std::vector<Entry>>& rows() const { return rows_; }

 private:
  void check_row(PetscInt row, const std::vector<Entry>& entries,
                 const std::vector<Entry>& mirrored) const;
  [[noreturn]] void fail(PetscInt row, PetscInt column, const std::string& what) const;

  std::string path_;
  const std::vector<PetscInt>& owned_dof_;
  const std::vector<PetscInt>& number_;
  std::vector<std::vector<Entry>> rows_;      ///< per owned dof: K_ij
  std::vector<std::vector<Entry>> mirrored_;  ///< per owned dof: K_ji, by j
  std::vector<double> diagonal_;              ///< per row of the file
  double largest_ = 0;                        ///< |K_ij|
};

}  // namespace pounding
