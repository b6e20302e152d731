#include "system/added_mass.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/matrix3.h"
#include "common/memory.h"
#include "common/petsc.h"
#include "common/row_products.h"

namespace pounding {
namespace {

constexpr std::size_t tile_size = 64;  ///< nodes
constexpr double full_matrices = 5;    ///< that are there at once

/// A, shape (n, n): a Schur complement of the Laplacian, by MUMPS.
std::vector<double> condensed_laplacian(const WaterBody& water) {
  const auto count = static_cast<PetscInt>(water.nodes.size());
  std::vector<PetscInt> begin(water.row_begin.begin(), water.row_begin.end());
  std::vector<PetscInt> columns(water.columns.begin(), water.columns.end());
  std::vector<double> values = water.laplacian;
  MatHandle matrix;
  MatHandle condensed;
  POUNDING_PETSC(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, water.pressures, water.pressures,
                                           begin.data(), columns.data(), values.data(),
                                           matrix.out()));
  if (count < water.pressures) {
    MatHandle factor;
    PetscHandle<IS, ISDestroy> kept;
    MatFactorInfo info;
    POUNDING_PETSC(MatSetOption(matrix.get(), MAT_SPD, PETSC_TRUE));
    POUNDING_PETSC(MatGetFactor(matrix.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()));
    POUNDING_PETSC(ISCreateStride(PETSC_COMM_SELF, count, 0, 1, kept.out()));
    POUNDING_PETSC(MatFactorSetSchurIS(factor.get(), kept.get()));
    POUNDING_PETSC(MatFactorInfoInitialize(&info));
    POUNDING_PETSC(MatCholeskyFactorSymbolic(factor.get(), matrix.get(), nullptr, &info));
    POUNDING_PETSC(MatCholeskyFactorNumeric(factor.get(), matrix.get(), &info));
    POUNDING_PETSC(MatFactorCreateSchurComplement(factor.get(), condensed.out(), nullptr));
  } else {
    POUNDING_PETSC(MatConvert(matrix.get(), MATSEQDENSE, MAT_INITIAL_MATRIX, condensed.out()));
  }
  const double* dense = nullptr;
  POUNDING_PETSC(MatDenseGetArrayRead(condensed.get(), &dense));
  std::vector<double> result(dense, dense + water.nodes.size() * water.nodes.size());
  POUNDING_PETSC(MatDenseRestoreArrayRead(condensed.get(), &dense));
  return result;
}

void require_memory(const WaterBody& water) {
  const double count = static_cast<double>(water.nodes.size());
  const double needed = full_matrices * sizeof(double) * count * count;
  if (needed <= available_memory()) return;
  throw UserError("option -" + water.pool + "_water: " + std::to_string(water.nodes.size()) +
                  " wetted nodes need " + std::to_string(std::lround(needed / 1e9)) +
                  " GB of memory on one rank; mesh its walls coarser");
}

}  // namespace

AddedMass::AddedMass(const Mesh& mesh, const WaterBody& water,
                     std::span<const double> lumped_mass) {
  find_nodes(mesh, water, lumped_mass);
  const std::size_t n = nodes_.size();
  if (n == 0) return;
  require_memory(water);
  std::vector<double> response = condensed_laplacian(water);
  const auto refuse = [&] {
    throw UserError("option -" + water.pool +
                    "_water: its mass is no positive definite matrix; "
                    "look for cells with sharp angles, and for walls next to no mass");
  };
  if (!invert_definite(response)) refuse();
  for (double& value : response) value *= water.density;  // rho A^-1
  find_ground_force(water, response);
  std::vector<double> h(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      h[i * n + j] =
          weight_[i] * response[wetted_[i] * water.nodes.size() + wetted_[j]] * weight_[j];
    }
    h[i * n + i] += 1;
  }
  response = {};
  if (!invert_definite(h)) refuse();
  for (double& value : h) value = -value;
  for (std::size_t i = 0; i < n; ++i) h[i * n + i] += 1;
  from_.resize(n);
  to_.resize(n);
  keep_tiles(h);
  for (const Tile& tile : tiles_) {
    part_.resize(std::max(part_.size(), tile.full ? tile.rows : tile.rank));
  }
  root_ = rest();
  if (!factorise_definite(root_)) refuse();
}

void AddedMass::find_nodes(const Mesh& mesh, const WaterBody& water,
                           std::span<const double> lumped_mass) {
  for (std::size_t k = 0; k < water.nodes.size(); ++k) {
    const LocalIndex node = mesh.owned_node(water.nodes[k]);
    for (int c = 0; node >= 0 && c < 3; ++c) {
      if (mesh.dof(node, c) < 0 || water.area[k][static_cast<std::size_t>(c)] == 0) continue;
      wetted_.push_back(k);
      break;
    }
  }
  std::vector<Vector3> place;
  for (const GlobalIndex node : water.nodes) {
    const LocalIndex owned = mesh.owned_node(node);
    place.push_back(owned < 0 ? Vector3{0, 0, 0} : mesh.position(owned));
  }
  begin_.push_back(0);
  sort_nodes(place, 0, wetted_.size());
  for (const std::size_t k : wetted_) add_node(mesh, water, lumped_mass, k);
}

void AddedMass::sort_nodes(std::span<const Vector3> place, std::size_t first, std::size_t end) {
  if (end - first <= tile_size) {
    if (end > first) begin_.push_back(end);
    return;
  }
  BoundingBox box;
  for (std::size_t i = first; i < end; ++i) box.include(place[wetted_[i]]);
  const Vector3 sides = box.sides();
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  const auto from = wetted_.begin() + static_cast<std::ptrdiff_t>(first);
  std::stable_sort(
      from, from + static_cast<std::ptrdiff_t>(end - first),
      [&](std::size_t a, std::size_t b) { return place[a][longest] < place[b][longest]; });
  const std::size_t middle = first + (end - first) / 2;
  sort_nodes(place, first, middle);
  sort_nodes(place, middle, end);
}

void AddedMass::add_node(const Mesh& mesh, const WaterBody& water,
                         std::span<const double> lumped_mass, std::size_t k) {
  const LocalIndex node = mesh.owned_node(water.nodes[k]);
  const auto n = static_cast<std::size_t>(node);
  const NodeDofs dofs{mesh.first_dof[n], component_count(mesh.free_components[n])};
  Vector3 unit{0, 0, 0};
  for (int c = 0; c < 3; ++c) {
    const LocalIndex dof = mesh.dof(node, c);
    if (dof < 0) continue;
    unit[static_cast<std::size_t>(dof - dofs.begin)] =
        water.area[k][static_cast<std::size_t>(c)] / std::sqrt(lumped_mass[dof]);
  }
  weight_.push_back(norm(unit));
  nodes_.push_back(dofs);
  unit_.push_back(normalised(unit));
  for (std::size_t c = 0; c < width; ++c) {
    const bool there = c < static_cast<std::size_t>(dofs.count);
    root_mass_.push_back(there ? std::sqrt(lumped_mass[dofs.begin + static_cast<int>(c)]) : 1);
    inverse_root_mass_.push_back(1 / root_mass_.back());
  }
}

void AddedMass::find_ground_force(const WaterBody& water, const std::vector<double>& response) {
  const std::size_t all = water.nodes.size();
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      double pressure = 0;
      for (std::size_t k = 0; k < all; ++k) {
        pressure += response[wetted_[i] * all + k] * water.area[k][d];
      }
      Vector3& force = ground_force_[d].emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        force[c] = pressure * weight_[i] * unit_[i][c] * root_mass_[width * i + c];
      }
    }
  }
}

void AddedMass::Tile::shorten() {
  std::vector<double> rest = left;
  std::vector<double> of_rows;
  std::vector<double> of_columns;
  const std::size_t most = std::min(tile_size / 2, rows * columns / (rows + columns));
  for (std::size_t count = 0; count <= most; ++count) {
    const auto largest =
        std::ranges::max_element(rest, {}, [](double value) { return std::abs(value); });
    if (std::abs(*largest) <= tile_error) {
      full = false;
      rank = count;
      left = std::move(of_rows);
      right = std::move(of_columns);
      return;
    }
    const double pivot = *largest;
    const auto place = static_cast<std::size_t>(largest - rest.begin());
    const std::size_t i_most = place / columns, j_most = place % columns;
    for (std::size_t i = 0; i < rows; ++i) of_rows.push_back(rest[i * columns + j_most]);
    for (std::size_t j = 0; j < columns; ++j) {
      of_columns.push_back(rest[i_most * columns + j] / pivot);
    }
    for (std::size_t i = 0; i < rows; ++i) {
      const double factor = of_rows[count * rows + i];
      for (std::size_t j = 0; j < columns; ++j) {
        rest[i * columns + j] -= factor * of_columns[count * columns + j];
      }
    }
  }
}

void AddedMass::keep_tiles(const std::vector<double>& h) {
  const auto keep = [&](const auto& recurse, std::array<std::size_t, 2> rows,
                        std::array<std::size_t, 2> columns) -> void {
    const auto halves = [](std::array<std::size_t, 2> of) {
      const std::size_t middle = of[0] + (of[1] - of[0]) / 2;
      return std::vector<std::array<std::size_t, 2>>{{of[0], middle}, {middle, of[1]}};
    };
    const bool smallest = rows[1] - rows[0] == 1 || columns[1] - columns[0] == 1;
    if (rows != columns || smallest) {
      Tile tile;
      tile.row = begin_[rows[0]];
      tile.column = begin_[columns[0]];
      tile.rows = begin_[rows[1]] - tile.row;
      tile.columns = begin_[columns[1]] - tile.column;
      for (std::size_t i = tile.row; i < tile.row + tile.rows; ++i) {
        const double* const row = &h[i * nodes_.size() + tile.column];
        tile.left.insert(tile.left.end(), row, row + tile.columns);
      }
      if (rows != columns) tile.shorten();
      if (smallest || !tile.full) {
        tiles_.push_back(std::move(tile));
        return;
      }
    }
    for (const auto& half : halves(rows)) {
      for (const auto& other : halves(columns)) {
        if (rows != columns || other[0] <= half[0]) recurse(recurse, half, other);
      }
    }
  };
  keep(keep, {0, begin_.size() - 1}, {0, begin_.size() - 1});
}

std::vector<double> AddedMass::rest() const {
  const std::size_t n = nodes_.size();
  std::vector<double> result(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    std::ranges::fill(from_, 0.0);
    from_[i] = -1;
    multiply(from_.data(), &result[i * n]);
    result[i * n + i] += 1;
  }
  for (std::size_t i = 0; i < n; ++i) {  // products of either side round differently
    for (std::size_t j = 0; j < i; ++j) result[j * n + i] = result[i * n + j];
  }
  return result;
}

void AddedMass::multiply(const double* q, double* t) const {
  std::fill_n(t, nodes_.size(), 0.0);
  for (const Tile& tile : tiles_) {
    const double* const of_rows = q + tile.row;
    const double* const of_columns = q + tile.column;
    double* const to_rows = t + tile.row;
    double* const to_columns = t + tile.column;
    if (tile.full) {
      multiply_rows(tile.left.data(), tile.rows, tile.columns, of_columns, part_.data());
      for (std::size_t i = 0; i < tile.rows; ++i) to_rows[i] += part_[i];
      if (tile.row != tile.column) {
        add_rows(tile.left.data(), tile.rows, tile.columns, of_rows, to_columns);
      }
    } else {
      multiply_rows(tile.right.data(), tile.rank, tile.columns, of_columns, part_.data());
      add_rows(tile.left.data(), tile.rank, tile.rows, part_.data(), to_rows);
      multiply_rows(tile.left.data(), tile.rank, tile.rows, of_rows, part_.data());
      add_rows(tile.right.data(), tile.rank, tile.columns, part_.data(), to_columns);
    }
  }
}

void AddedMass::collect(const double* x, double* q) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double* const at = x + width * i;
    q[i] = unit_[i][0] * at[0] + unit_[i][1] * at[1] + unit_[i][2] * at[2];
  }
}

void AddedMass::spread(const double* q, double* x) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) x[width * i + c] += unit_[i][c] * q[i];
  }
}

void AddedMass::scale(double* x) const {
  for (std::size_t k = 0; k < inverse_root_mass_.size(); ++k) x[k] *= inverse_root_mass_[k];
}

void AddedMass::solve(double* x) const {
  scale(x);
  collect(x, from_.data());
  multiply(from_.data(), to_.data());
  for (double& value : to_) value = -value;
  spread(to_.data(), x);
  scale(x);
}

void AddedMass::solve_half(double* x) const {
  const std::size_t n = nodes_.size();
  scale(x);
  collect(x, from_.data());
  for (std::size_t i = 0; i < n; ++i) to_[i] = -from_[i];
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) to_[j] += root_[i * n + j] * from_[i];
  }
  spread(to_.data(), x);
}

void AddedMass::solve_transposed_half(double* x) const {
  const std::size_t n = nodes_.size();
  collect(x, from_.data());
  for (std::size_t i = 0; i < n; ++i) {
    const double* const row = &root_[i * n];
    to_[i] = std::inner_product(row, row + i + 1, from_.data(), -from_[i]);
  }
  spread(to_.data(), x);
  scale(x);
}

double AddedMass::added_product(const double* v) const {
  const std::size_t n = nodes_.size();
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {  // T w = q, q = Y^T M^1/2 v: w . w - q . q
    double q = 0;
    for (std::size_t c = 0; c < 3 && c < static_cast<std::size_t>(nodes_[i].count); ++c) {
      q += unit_[i][c] * root_mass_[width * i + c] *
           v[static_cast<std::size_t>(nodes_[i].begin) + c];
    }
    const double* const row = &root_[i * n];
    const double known = std::inner_product(row, row + i, from_.data(), 0.0);
    from_[i] = (q - known) / row[i];
    total += (from_[i] - q) * (from_[i] + q);
  }
  return total;
}

std::vector<AddedMass::Entry> AddedMass::entries_of(const std::vector<double>& b,
                                                    const std::vector<double>& scaling) const {
  std::vector<Entry> entries;
  const std::size_t n = nodes_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < 9; ++k) {
        const std::size_t r = k / 3, c = k % 3;
        const double value = unit_[i][r] * scaling[width * i + r] * b[i * n + j] *
                             scaling[width * j + c] * unit_[j][c];
        if (value == 0) continue;
        entries.push_back({nodes_[i].begin + static_cast<LocalIndex>(r),
                           nodes_[j].begin + static_cast<LocalIndex>(c), value});
      }
    }
  }
  return entries;
}

std::vector<AddedMass::Entry> AddedMass::mass_entries() const {
  std::vector<double> added = rest();
  invert_definite(added);
  for (std::size_t i = 0; i < nodes_.size(); ++i) added[i * nodes_.size() + i] -= 1;
  return entries_of(added, root_mass_);
}

std::vector<AddedMass::Entry> AddedMass::half_entries() const {
  std::vector<double> less = root_;
  for (std::size_t i = 0; i < nodes_.size(); ++i) less[i * nodes_.size() + i] -= 1;
  return entries_of(less, std::vector<double>(root_mass_.size(), 1.0));
}

}  // namespace pounding
