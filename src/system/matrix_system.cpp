#include "system/matrix_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <sstream>

#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "common/types.h"
#include "io/matrix_market.h"
#include "system/mass_scaling.h"
#include "system/square_matrix.h"

namespace pounding {
namespace {

/// Positions of a row and of a node that differ by less than this part of the mesh are the same.
constexpr double same_place = 1e-6;

/// Meaning of a row of the matrices.
struct ListedDof {
  Vector3 position{0, 0, 0};
  int component = 0;
  std::string label;  ///< of the node in the program that wrote it, may be empty
};

std::vector<ListedDof> read_rows(const std::string& path) {
  require_finite_file(path);
  std::ifstream file(path);
  if (!file) throw UserError(path + ": no such file, or it cannot be read");
  std::vector<ListedDof> rows;
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    ListedDof row;
    std::string component;
    if (line.empty() || line[0] == '#' || line.starts_with("x y z")) continue;
    words >> row.position[0] >> row.position[1] >> row.position[2] >> component;
    const auto found = std::ranges::find(component_names, component);
    if (!words || found == component_names.end()) {
      throw UserError(path + ", line " + std::to_string(number) +
                      ": expected x,y,z,component with a component ux, uy, uz, rx, ry or rz");
    }
    row.component = static_cast<int>(found - component_names.begin());
    std::getline(words >> std::ws, row.label);
    rows.push_back(row);
  }
  if (rows.empty()) throw UserError(path + ": no rows");
  return rows;
}

/// "node 1203 at (x, y, z)", or without a label "node at (x, y, z)".
std::string node_text(const ListedDof& row) {
  return "node " + row.label + (row.label.empty() ? "" : " ") + "at " + place_text(row.position);
}

/// Finds the nodes of this rank by position.
class NodeFinder {
 public:
  explicit NodeFinder(const Mesh& mesh) : mesh_(mesh) {
    order_.resize(mesh.node_count());
    std::iota(order_.begin(), order_.end(), LocalIndex{0});
    std::ranges::sort(order_, {}, [&](LocalIndex node) { return mesh.position(node)[0]; });
    std::array<double, 2> ends{1e300, 1e300};  // smallest x, minus the largest, and so on
    for (std::size_t d = 0; d < 3; ++d) {
      ends = {1e300, 1e300};
      for (const LocalIndex node : order_) {
        ends = {std::min(ends[0], mesh.position(node)[d]),
                std::min(ends[1], -mesh.position(node)[d])};
      }
      reduce_over_ranks(mesh.comm, MPI_MIN, ends);
      tolerance_ = std::max(tolerance_, same_place * -(ends[0] + ends[1]));
    }
  }

  /// Local node at a position, -1 if this rank has none there.
  LocalIndex at(const Vector3& x) const {
    const auto coordinate = [&](LocalIndex node) { return mesh_.position(node)[0]; };
    for (auto near = std::ranges::lower_bound(order_, x[0] - tolerance_, {}, coordinate);
         near != order_.end() && coordinate(*near) <= x[0] + tolerance_; ++near) {
      const Vector3 p = mesh_.position(*near);
      if (std::abs(p[1] - x[1]) <= tolerance_ && std::abs(p[2] - x[2]) <= tolerance_) return *near;
    }
    return -1;
  }

 private:
  const Mesh& mesh_;
  std::vector<LocalIndex> order_;  ///< by x
  double tolerance_ = 0;           ///< [m]
};

/// Reads the folder and builds the system from it.
class MatrixSystem {
 public:
  MatrixSystem(const Structure& structure, const Mesh& mesh)
      : folder_(structure.matrices), mesh_(mesh) {
    on_every_rank(mesh.comm, [&] { rows_ = read_rows(folder_ + "/dofs.csv"); });
    find_dofs();
  }

  void fill(LinearSystem& system) {
    on_every_rank(mesh_.comm, [&] { read_mass(system); });
    reduce_over_ranks(mesh_.comm, MPI_MAX, system.total_mass);
    const bool labelled =
        std::ranges::any_of(rows_, [](const ListedDof& row) { return !row.label.empty(); });
    if (labelled) system.node_labels = std::move(labels_);
    system.stiffness = std::make_unique<stiffness::AssembledStiffness>(read_square("stiffness"));
    if (!matrix_file(folder_, "damping").empty()) {
      system.extra_damping =
          std::make_unique<stiffness::AssembledStiffness>(read_square("damping"));
    }
    bound_frequency(system);
  }

 private:
  std::string needed_path_of(const std::string& name) const {
    std::string path = matrix_file(folder_, name);
    refuse_if(path.empty(), folder_ + ": neither " + name + ".mtx nor " + name + ".petsc is there");
    return path;
  }

  /// ListedDof by row the dof that it is; every free dof of the mesh must have one row.
  void find_dofs() {
    const NodeFinder finder(mesh_);
    labels_.resize(mesh_.owned_dofs);
    std::vector<int> known(rows_.size(), 0);
    std::vector<PetscInt> times(mesh_.owned_dofs, 0);
    number_.assign(rows_.size(), -1);
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const LocalIndex node = finder.at(rows_[row].position);
      known[row] = node >= 0 ? 1 : 0;
      if (node >= 0 && node < mesh_.owned_nodes) {
        const LocalIndex dof = mesh_.dof(node, rows_[row].component);
        number_[row] = static_cast<PetscInt>(mesh_.dof_global(node, rows_[row].component));
        times[std::max(dof, 0)] += dof >= 0 ? 1 : 0;
        if (dof >= 0) labels_[dof] = rows_[row].label;
      }
    }
    reduce_over_ranks(mesh_.comm, MPI_MAX, known, number_);
    on_every_rank(mesh_.comm, [&] {
      for (std::size_t row = 0; row < rows_.size(); ++row) {
        if (known[row] == 0) {
          throw UserError(folder_ + "/dofs.csv: the mesh of " + mesh_.structure + " has no " +
                          node_text(rows_[row]));
        }
      }
      check_dofs(times);
    });
    const auto first = static_cast<PetscInt>(mesh_.first_owned_dof);
    for (const PetscInt number : number_) {
      const bool owned = number >= first && number < first + mesh_.owned_dofs;
      owned_dof_.push_back(owned ? number - first : -1);
    }
  }

  void check_dofs(const std::vector<PetscInt>& times) const {
    for_each_owned_dof(mesh_, [&](LocalIndex dof, LocalIndex node, int c) {
      if (times[dof] == 1) return;
      throw UserError(sentence("{}/dofs.csv: {} for {} of the node at {} of {}",
                               {folder_, times[dof] == 0 ? "no row" : "more than one row",
                                component_names[c], mesh_.position(node), mesh_.structure}));
    });
  }

  void check_size(const std::string& path, const MatrixSize& size, bool vector) const {
    const auto rows = static_cast<PetscInt>(rows_.size());
    refuse_if(size.rows != rows || (size.columns != rows && !(vector && size.columns == 1)),
              path + ": " + std::to_string(size.rows) + " x " + std::to_string(size.columns) +
                  ", but dofs.csv has " + std::to_string(rows_.size()) + " rows");
  }

  /// A row number beyond dofs.csv is reported by its size, not read.
  bool inside(const MatrixEntry& entry, bool vector) const {
    const auto rows = static_cast<PetscInt>(rows_.size());
    return entry.row < rows && (entry.column < rows || vector);
  }

  void read_mass(LinearSystem& system) const {
    system.lumped_mass.assign(mesh_.owned_dofs, 0.0);
    std::vector<double> row_sum(rows_.size(), 0.0);
    std::vector<double> diagonal(rows_.size(), 0.0);
    std::vector<double> column(rows_.size(), 0.0);
    const std::string path = needed_path_of("mass");
    const MatrixSize size = read_matrix(path, [&](const MatrixEntry& entry) {
      if (!inside(entry, false)) return;
      const std::size_t i = entry.row;
      const std::size_t j = entry.column;
      row_sum[i] += rows_[i].component == rows_[j].component ? entry.value : 0;
      diagonal[i] += i == j ? entry.value : 0;
      column[i] += j == 0 ? entry.value : 0;
    });
    check_size(path, size, true);
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const double lumped = rows_[row].component < 3 ? row_sum[row] : diagonal[row];
      const double mass = size.columns == 1 && size.rows > 1 ? column[row] : lumped;
      system.total_mass += rows_[row].component == 0 ? mass : 0;
      if (owned_dof_[row] >= 0) system.lumped_mass[owned_dof_[row]] = mass;
      if (number_[row] >= 0 && !(mass > 0)) {
        throw UserError(path + ": row " + std::to_string(row + 1) + " (" +
                        std::string(motion_names[rows_[row].component]) + " of " +
                        node_text(rows_[row]) +
                        ") has no mass, and a step condenses nothing: condense it out of the "
                        "matrices (docs/manual/matrices.md), or give it a mass");
      }
    }
  }

  MatHandle read_square(const std::string& name) const {
    std::optional<SquareMatrix> read;
    on_every_rank(mesh_.comm, [&] {
      const std::string path = needed_path_of(name);
      SquareMatrix& matrix =
          read.emplace(path, owned_dof_, number_, static_cast<std::size_t>(mesh_.owned_dofs));
      const MatrixSize size = read_matrix(path, [&](const MatrixEntry& entry) {
        if (inside(entry, false)) matrix.add(entry);
      });
      check_size(path, size, false);
      matrix.finish();
      matrix.check();
    });
    return matrix_of(read->rows());
  }

  MatHandle matrix_of(const std::vector<std::vector<SquareMatrix::Entry>>& rows) const {
    const auto first = static_cast<PetscInt>(mesh_.first_owned_dof);
    const auto number = [&](const SquareMatrix::Entry& entry) { return number_[entry.first]; };
    std::vector<PetscInt> own;  // with one more, for a diagonal that the file leaves out
    std::vector<PetscInt> other;
    for (const auto& row : rows) {
      const auto mine = std::ranges::count_if(row, [&](const SquareMatrix::Entry& entry) {
        return number(entry) >= first && number(entry) < first + mesh_.owned_dofs;
      });
      own.push_back(std::min(static_cast<PetscInt>(mine) + 1, mesh_.owned_dofs));
      other.push_back(static_cast<PetscInt>(row.size()) - static_cast<PetscInt>(mine));
    }
    MatHandle matrix;
    POUNDING_PETSC(MatCreateAIJ(mesh_.comm, mesh_.owned_dofs, mesh_.owned_dofs, PETSC_DETERMINE,
                                PETSC_DETERMINE, 0, own.data(), 0, other.data(), matrix.out()));
    POUNDING_PETSC(MatSetOption(matrix.get(), MAT_USE_INODES, PETSC_FALSE));
    POUNDING_PETSC(MatSetOption(matrix.get(), MAT_SYMMETRIC, PETSC_TRUE));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const PetscInt place = first + static_cast<PetscInt>(row);
      POUNDING_PETSC(MatSetValue(matrix.get(), place, place, 0, ADD_VALUES));
      for (const SquareMatrix::Entry& entry : rows[row]) {
        POUNDING_PETSC(MatSetValue(matrix.get(), place, number(entry), entry.second, ADD_VALUES));
      }
    }
    assemble(matrix.get());
    return matrix;
  }

  /// Gershgorin on M^-1/2 K M^-1/2: no omega^2 is beyond the largest sum of |K_ij| (m_i m_j)^-1/2
  /// over a row.
  static void bound_frequency(LinearSystem& system) {
    std::vector<double> root;
    for (const double mass : system.lumped_mass) root.push_back(1 / std::sqrt(mass));
    const VecHandle scale = wrap_vector(system, root);
    MatHandle scaled;
    POUNDING_PETSC(MatDuplicate(system.stiffness->matrix(), MAT_COPY_VALUES, scaled.out()));
    POUNDING_PETSC(MatDiagonalScale(scaled.get(), scale.get(), scale.get()));
    double square = 0;
    POUNDING_PETSC(MatNorm(scaled.get(), NORM_INFINITY, &square));
    system.element_frequency_bound = std::sqrt(square);
    system.element_time_step_bound =
        system.extra_damping
            ? 0
            : critical_time_step(system.damping.alpha + system.damping.beta * square,
                                 system.stiffening() * square);
  }

  std::string folder_;
  const Mesh& mesh_;
  std::vector<ListedDof> rows_;
  std::vector<PetscInt> number_;     ///< per row of the files, global dof; -1: clamped
  std::vector<PetscInt> owned_dof_;  ///< local dof, -1: of another rank, or clamped
  std::vector<std::string> labels_;  ///< of the node of every owned dof
};

}  // namespace

std::string matrix_file(const std::string& folder, const std::string& name) {
  const std::string text = folder + "/" + name + ".mtx";
  const std::string binary = folder + "/" + name + ".petsc";
  const bool is_text = std::filesystem::exists(text);
  const bool is_binary = std::filesystem::exists(binary);
  refuse_if(is_text && is_binary,
            text + ": the same matrix is in " + name + ".petsc as well; remove one of them");
  return is_text ? text : (is_binary ? binary : "");
}

LinearSystem build_matrix_system(const Structure& structure, const Mesh& mesh) {
  LinearSystem system = describe_system(structure, mesh);
  MatrixSystem(structure, mesh).fill(system);
  finish_system(mesh, system);
  system.stiffness_method = "assembled, from " + structure.matrices;
  return system;
}

}  // namespace pounding
