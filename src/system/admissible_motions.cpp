#include "system/admissible_motions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pounding {
namespace {

const std::vector<RigidBody>& bodies_of(const LinearSystem& system) {
  static const std::vector<RigidBody> none;
  return system.coupled_mass ? system.coupled_mass->bodies() : none;
}

const std::vector<TiedPart>& ties_of(const LinearSystem& system) {
  static const std::vector<TiedPart> none;
  return system.coupled_mass ? system.coupled_mass->ties() : none;
}

/// Takes the values of a tie's dofs out of a vector over the owned dofs, and puts them back.
std::vector<double> field_of(const TiedPart& tie, const std::vector<double>& owned) {
  std::vector<double> field(TiedPart::width * tie.nodes().size(), 0.0);
  for (std::size_t n = 0; n < tie.nodes().size(); ++n) {
    const NodeDofs& node = tie.nodes()[n];
    std::copy_n(owned.data() + node.begin, node.count, field.data() + TiedPart::width * n);
  }
  return field;
}
void put_field(const TiedPart& tie, const std::vector<double>& field, std::vector<double>& owned) {
  for (std::size_t n = 0; n < tie.nodes().size(); ++n) {
    const NodeDofs& node = tie.nodes()[n];
    std::copy_n(field.data() + TiedPart::width * n, node.count, owned.data() + node.begin);
  }
}

/// Size of the diagonal entries of a matrix. Collective.
double largest_diagonal(Mat matrix) {
  VecHandle diagonal;
  PetscReal largest = 0;
  POUNDING_PETSC(MatCreateVecs(matrix, diagonal.out(), nullptr));
  POUNDING_PETSC(MatGetDiagonal(matrix, diagonal.get()));
  POUNDING_PETSC(VecNorm(diagonal.get(), NORM_INFINITY, &largest));
  return largest;
}

}  // namespace

AdmissibleMotions::AdmissibleMotions(const LinearSystem& system, Alone alone)
    : system_(system), alone_(alone), is_idle_(system.lumped_mass.size(), 0) {
  const LocalIndex n = system.owned_dofs();
  std::vector<char> in_body(is_idle_.size(), 0);
  const std::vector<Entry> entries = tie_entries(in_body);
  std::vector<PetscInt> counts(is_idle_.size(), RigidBody::width);
  for (const Entry& entry : entries) ++counts[entry.row];
  for (PetscInt& count : counts) count = std::min(count, n);  // PETSc refuses more than a row has
  POUNDING_PETSC(MatCreateAIJ(system.comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 0, counts.data(),
                              0, nullptr, matrix_.out()));
  const PetscInt first = first_row(matrix_.get());
  for (const RigidBody& body : bodies_of(system)) {
    std::array<PetscInt, RigidBody::width> columns{};
    for (std::size_t k = 0; k < body.dofs().size(); ++k) {
      in_body[body.dofs()[k]] = 1;
      is_idle_[body.dofs()[k]] = k < body.motions() ? 0 : 1;
      if (k < body.motions()) columns[k] = first + body.dofs()[k];
    }
    for (std::size_t k = 0; k < body.dofs().size(); ++k) {
      const PetscInt row = first + body.dofs()[k];
      POUNDING_PETSC(MatSetValues(matrix_.get(), 1, &row, static_cast<PetscInt>(body.motions()),
                                  columns.data(), body.row(k).data(), INSERT_VALUES));
    }
  }
  for (const auto& [row, column, value] : entries) {
    POUNDING_PETSC(MatSetValue(matrix_.get(), first + row, first + column, value, INSERT_VALUES));
  }
  for (LocalIndex i = 0; i < n; ++i) {
    if (in_body[i] != 0) continue;
    const double value = alone == Alone::as_is ? 1 : std::sqrt(system.inverse_mass[i]);
    POUNDING_PETSC(MatSetValue(matrix_.get(), first + i, first + i, value, INSERT_VALUES));
  }
  assemble(matrix_.get());
}

std::vector<AdmissibleMotions::Entry> AdmissibleMotions::tie_entries(std::vector<char>& coupled) {
  std::vector<Entry> entries;
  for (const TiedPart& tie : ties_of(system_)) {
    std::vector<double> field(TiedPart::width * tie.nodes().size());
    const auto for_each_dof = [&](std::size_t first, std::size_t end, const auto& visit) {
      for (std::size_t n = first; n < end; ++n) {
        const NodeDofs& node = tie.nodes()[n];
        for (int i = 0; i < node.count; ++i) {
          visit(node.begin + i, TiedPart::width * n + static_cast<std::size_t>(i));
        }
      }
    };
    for_each_dof(0, tie.nodes().size(), [&](LocalIndex dof, std::size_t) { coupled[dof] = 1; });
    for_each_dof(tie.carriers(), tie.nodes().size(),
                 [&](LocalIndex dof, std::size_t) { is_idle_[dof] = 1; });
    for_each_dof(0, tie.carriers(), [&](LocalIndex column, std::size_t place) {
      std::ranges::fill(field, 0.0);
      field[place] = 1;
      if (alone_ == Alone::as_is) {
        tie.spread(field.data());
      } else {
        tie.solve_transposed_half(field.data());
      }
      for_each_dof(0, tie.nodes().size(), [&](LocalIndex row, std::size_t from) {
        if (field[from] != 0) entries.push_back({row, column, field[from]});
      });
    });
  }
  return entries;
}

MatHandle AdmissibleMotions::restrict_matrix(Mat matrix, double idle) const {
  MatHandle restricted;
  POUNDING_PETSC(
      MatPtAP(matrix, matrix_.get(), MAT_INITIAL_MATRIX, PETSC_DEFAULT, restricted.out()));
  const double value = idle > 0 ? idle : 2 * largest_diagonal(restricted.get());
  std::vector<double> idle_values;
  for (const char is_idle : is_idle_) idle_values.push_back(is_idle != 0 ? value : 0);
  const MatHandle diagonal = diagonal_matrix(system_.comm, idle_values);
  POUNDING_PETSC(MatAXPY(restricted.get(), 1, diagonal.get(), DIFFERENT_NONZERO_PATTERN));
  POUNDING_PETSC(MatSetOption(restricted.get(), MAT_SYMMETRIC, PETSC_TRUE));
  return restricted;
}

void AdmissibleMotions::multiply(std::vector<double>& x, bool transposed) const {
  std::vector<double> result(x.size());
  const VecHandle from = wrap_vector(system_, x);
  const VecHandle to = wrap_vector(system_, result);
  POUNDING_PETSC(transposed ? MatMultTranspose(matrix_.get(), from.get(), to.get())
                            : MatMult(matrix_.get(), from.get(), to.get()));
  std::ranges::copy(result, x.begin());  // in place: vectors may rest on it
}

void AdmissibleMotions::to_coordinates(std::vector<double>& u) const {
  const std::vector<double> motion = u;
  if (alone_ == Alone::mass_scaled) {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] *= std::sqrt(system_.lumped_mass[i]);
  }
  for (const RigidBody& body : bodies_of(system_)) {
    std::array<double, RigidBody::width> q{};
    for (std::size_t k = 0; k < body.dofs().size(); ++k) {
      const LocalIndex dof = body.dofs()[k];
      u[dof] = 0;
      for (std::size_t m = 0; m < body.motions(); ++m) {
        q[m] += body.row(k)[m] * system_.lumped_mass[dof] * motion[dof];
      }
    }
    for (std::size_t m = 0; m < body.motions(); ++m) u[body.dofs()[m]] = q[m];
  }
  for (const TiedPart& tie : ties_of(system_)) {
    std::vector<double> field = field_of(tie, motion);
    if (alone_ == Alone::mass_scaled) {  // T^T M T = I
      std::vector<double> force = motion;
      for (std::size_t i = 0; i < force.size(); ++i) force[i] *= system_.lumped_mass[i];
      field = field_of(tie, force);
      tie.solve_half(field.data());
    }
    std::fill(field.begin() + static_cast<std::ptrdiff_t>(TiedPart::width * tie.carriers()),
              field.end(), 0.0);
    put_field(tie, field, u);
  }
}

void take_up_by_constraints(const LinearSystem& system, std::vector<double>& f) {
  for (const TiedPart& tie : ties_of(system)) {
    std::vector<double> field = field_of(tie, f);
    tie.solve(field.data());
    put_field(tie, field, f);
    for (const NodeDofs& node : tie.nodes()) {
      for (int i = 0; i < node.count; ++i) {
        f[node.begin + i] *= system.lumped_mass[node.begin + i];
      }
    }
  }
  for (const RigidBody& body : bodies_of(system)) {
    std::array<double, RigidBody::width> q{};
    for (std::size_t k = 0; k < body.dofs().size(); ++k) {
      for (std::size_t m = 0; m < body.motions(); ++m) q[m] += body.row(k)[m] * f[body.dofs()[k]];
    }
    for (std::size_t k = 0; k < body.dofs().size(); ++k) {
      const LocalIndex dof = body.dofs()[k];
      double sum = 0;
      for (std::size_t m = 0; m < body.motions(); ++m) sum += body.row(k)[m] * q[m];
      f[dof] = system.lumped_mass[dof] * sum;
    }
  }
}

Vector3 handed_to_clamps(const LinearSystem& system, const std::vector<double>& f) {
  Vector3 total{0, 0, 0};
  for (const TiedPart& tie : ties_of(system)) {
    std::vector<double> field = field_of(tie, f);
    std::fill_n(field.begin(), TiedPart::width * tie.carriers(), 0.0);
    const auto add = [&](double sign) {
      for (std::size_t n = 0; n < tie.nodes().size(); ++n) {
        for (int i = 0; i < tie.nodes()[n].count; ++i) {
          const int direction = system.direction[tie.nodes()[n].begin + i];
          const std::size_t place = TiedPart::width * n + static_cast<std::size_t>(i);
          if (direction >= 0) total[direction] += sign * field[place];
        }
      }
    };
    add(1);
    tie.collect(field.data());
    add(-1);
  }
  return total;
}

}  // namespace pounding
