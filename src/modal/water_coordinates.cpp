#include "modal/water_coordinates.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pounding {

WaterCoordinates::WaterCoordinates(const LinearSystem& system) : system_(system) {
  if (!system.wet) return;
  const LocalIndex n = system.owned_dofs();
  std::vector<AddedMass::Entry> entries;
  std::vector<PetscInt> counts(system.lumped_mass.size(), 1);
  for (const AddedMass& water : system.waters()) {
    std::ranges::copy(water.half_entries(), std::back_inserter(entries));
  }
  for (const AddedMass::Entry& entry : entries) ++counts[entry.row];
  for (PetscInt& count : counts) count = std::min(count, n);  // PETSc refuses more than a row has
  for (LocalIndex i = 0; i < n; ++i) entries.push_back({i, i, 1});
  POUNDING_PETSC(MatCreateAIJ(system.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0, counts.data(),
                              0, nullptr, half_.out()));
  const PetscInt first = first_row(half_.get());
  for (const auto& [row, column, value] : entries) {
    POUNDING_PETSC(MatSetValue(half_.get(), first + row, first + column, value, ADD_VALUES));
  }
  assemble(half_.get());
}

void WaterCoordinates::restrict_matrix(MatHandle& matrix) const {
  if (half_.get() == nullptr || matrix.get() == nullptr) return;
  MatHandle restricted;
  POUNDING_PETSC(
      MatPtAP(matrix.get(), half_.get(), MAT_INITIAL_MATRIX, PETSC_DEFAULT, restricted.out()));
  POUNDING_PETSC(MatSetOption(restricted.get(), MAT_SYMMETRIC, PETSC_TRUE));
  matrix = std::move(restricted);
}

void WaterCoordinates::multiply(DenseMatrix& x, PetscErrorCode (*product)(Mat, Vec, Vec)) const {
  for (std::size_t j = 0; half_.get() != nullptr && j < x.columns; ++j) {
    std::vector<double> from(x.column(j), x.column(j) + x.rows);
    std::vector<double> to(x.rows);
    const VecHandle argument = wrap_vector(system_, from);
    const VecHandle result = wrap_vector(system_, to);
    POUNDING_PETSC(product(half_.get(), argument.get(), result.get()));
    std::ranges::copy(to, x.column(j));
  }
}

}  // namespace pounding
