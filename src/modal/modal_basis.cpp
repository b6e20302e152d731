#include "modal/modal_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/parallel.h"
#include "modal/eigen_solver.h"
#include "modal/rigid_motions.h"
#include "modal/shifted_solver.h"
#include "system/admissible_motions.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

/// Part of a vector that is left outside a space, at which it counts as inside.
constexpr double inside_span = 1e-8;

/// Relative difference of two eigenvalues that are the same.
constexpr double same_eigenvalue = 1e-7;

double dot(const double* a, const double* b, std::size_t n) {
  return std::inner_product(a, a + n, b, 0.0);
}

double norm(const std::vector<double>& a) {
  return std::sqrt(dot(a.data(), a.data(), a.size()));
}

void scale(std::vector<double>& a, double factor) {
  std::transform(a.begin(), a.end(), a.begin(), [&](double value) { return factor * value; });
}

/// a -= b (b . a)
void take_off(const double* b, std::vector<double>& a) {
  const double part = dot(b, a.data(), a.size());
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= part * b[i];
}

/// Orthonormal columns, shape (dofs, k), in y = M^1/2 u.
class BasisMaker {
 public:
  BasisMaker(const LinearSystem& system, const Mesh& mesh, const ModalRequest& request)
      : system_(system),
        mesh_(mesh),
        request_(request),
        matrix_(mass_scaled(system, system.stiffest_matrix())),
        dofs_(system.lumped_mass.size()),
        independent_(static_cast<std::size_t>(system.independent_dofs())),
        space_(dofs_, 0) {
    if (system.rigid_bodies.empty()) return;
    admissible_.emplace(system, AdmissibleMotions::Alone::mass_scaled);
    restricted_ = admissible_->restrict_matrix(system.stiffest_matrix());
    idle_ = idle_value();
  }

  ModalBasis make() {
    ModalBasis basis;
    const std::size_t wanted = wanted_modes();
    add_modes(
        std::max(wanted, std::min(static_cast<std::size_t>(request_.candidates), independent_)));
    if (request_.candidates > request_.modes) choose_modes(wanted);
    basis.modes = static_cast<int>(space_.columns);
    if (space_.columns < independent_) add_attachment_vectors();
    basis.attachment_vectors = static_cast<int>(space_.columns) - basis.modes;
    basis.full_dofs = system_.global_dofs;
    basis.total_mass = system_.total_mass;
    rotate(basis);
    return basis;
  }

 private:
  std::size_t wanted_modes() const {
    if (request_.modes > 0) return std::min(static_cast<std::size_t>(request_.modes), independent_);
    const double omega = 2 * std::numbers::pi * request_.cutoff;
    const int below = ShiftedSolver(system_, lowest_matrix(), omega * omega).eigenvalues_below();
    if (below == 0) {
      std::ostringstream text;
      text << "option -" << system_.name << "_modal_cutoff " << request_.cutoff
           << " Hz: no mode of the structure lies below it; give a higher one";
      throw UserError(text.str());
    }
    return static_cast<std::size_t>(below);
  }

  /// Matrix that has the modes' frequencies, in y or in the coordinates z of rigid bodies.
  Mat lowest_matrix() const { return admissible_ ? restricted_.get() : matrix_.get(); }

  /// Beyond every frequency [1/s2].
  double idle_value() const {
    PetscReal norm = 0;
    POUNDING_PETSC(MatNorm(matrix_.get(), NORM_INFINITY, &norm));
    return 2 * norm;
  }

  /// y of z, and z of what acts on y: y = M^1/2 T z with orthonormal columns.
  void from_coordinates(std::vector<double>& z) const {
    if (!admissible_) return;
    admissible_->to_motion(z);
    for (std::size_t i = 0; i < dofs_; ++i) z[i] *= std::sqrt(system_.lumped_mass[i]);
  }
  void to_coordinates(std::vector<double>& y) const {
    if (!admissible_) return;
    for (std::size_t i = 0; i < dofs_; ++i) y[i] *= std::sqrt(system_.lumped_mass[i]);
    admissible_->to_coordinates_of_force(y);
  }
  /// Takes out of y what no rigid body admits.
  void admit(std::vector<double>& y) const {
    to_coordinates(y);
    from_coordinates(y);
  }

  /// A x; what rigid bodies do not admit has eigenvalues beyond all others.
  void multiply(const double* x, double* product) const {
    std::vector<double> from(x, x + dofs_);
    admit(from);
    std::vector<double> to(dofs_);
    const VecHandle argument = wrap_vector(system_, from);
    const VecHandle result = wrap_vector(system_, to);
    POUNDING_PETSC(MatMult(matrix_.get(), argument.get(), result.get()));
    admit(to);
    for (std::size_t i = 0; admissible_ && i < dofs_; ++i) to[i] += idle_ * (x[i] - from[i]);
    std::copy(to.begin(), to.end(), product);
  }

  void add_modes(std::size_t wanted) {
    std::vector<double> values;
    DenseMatrix vectors(dofs_, 0);
    if (3 * (wanted + 8) > dofs_) {
      vectors = DenseMatrix(dofs_, dofs_);
      std::vector<double> unit(dofs_, 0.0);
      for (std::size_t j = 0; j < dofs_; ++j) {
        unit[j] = 1;
        multiply(unit.data(), vectors.column(j));
        unit[j] = 0;
      }
      values = symmetric_eigenvalues(vectors);
    } else {
      find_modes(wanted, values, vectors);
    }
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    const double last = values[order[wanted - 1]];
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i < wanted || values[order[i]] <= last + same_eigenvalue * std::abs(last)) {
        const double* y = vectors.column(order[i]);
        space_.append({y, y + dofs_});
        squared_frequency_.push_back(values[order[i]]);
        mode_numbers_.push_back(static_cast<int>(mode_numbers_.size()) + 1);
      }
    }
  }

  /// Keeps so many of the candidates that are the space so far.
  void choose_modes(std::size_t wanted) {
    const std::size_t candidates = space_.columns;
    std::vector<double> share(candidates, 0.0);
    for (const auto* points : {&request_.contact_points, &request_.other_points}) {
      for (const TracePoint& point : *points) add_shares(point, share);
    }
    std::vector<std::size_t> order(candidates);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(wanted * 3 / 4);
    std::stable_sort(first, order.end(),
                     [&](std::size_t a, std::size_t b) { return share[a] > share[b]; });
    order.resize(wanted);
    std::ranges::sort(order);
    DenseMatrix chosen(dofs_, 0);
    std::vector<int> numbers;
    for (const std::size_t j : order) {
      chosen.append({space_.column(j), space_.column(j) + dofs_});
      numbers.push_back(mode_numbers_[j]);
    }
    space_ = std::move(chosen);
    mode_numbers_ = std::move(numbers);
  }

  /// phi^2 / omega^2 of each mode at a point, relative to the sum of all phi^2 there.
  void add_shares(const TracePoint& point, std::vector<double>& share) const {
    const LocalIndex dof = mesh_.dof(mesh_.owned_node(point.node), point.component);
    double sum = 0;
    for (std::size_t j = 0; dof >= 0 && j < share.size(); ++j) {
      sum += std::pow(space_.column(j)[dof], 2);
    }
    for (std::size_t j = 0; sum > 0 && j < share.size(); ++j) {
      const double square = std::max(squared_frequency_[j], 1e-6);  // rigid motions are all alike
      share[j] += std::pow(space_.column(j)[dof], 2) / (square * sum);
    }
  }

  void find_modes(std::size_t wanted, std::vector<double>& values, DenseMatrix& vectors) const {
    const EpsHandle solver =
        solve_lowest(system_, mesh_, lowest_matrix(), static_cast<int>(wanted));
    PetscInt found = 0;
    POUNDING_PETSC(EPSGetConverged(solver.get(), &found));
    std::vector<double> storage(dofs_);
    const VecHandle vector = wrap_vector(system_, storage);
    for (PetscInt i = 0; i < found; ++i) {
      double value = 0;
      POUNDING_PETSC(EPSGetEigenpair(solver.get(), i, &value, nullptr, vector.get(), nullptr));
      values.push_back(value);
      std::vector<double> y = storage;
      from_coordinates(y);
      vectors.append(y);
    }
  }

  void project(std::vector<double>& x) const {
    for (std::size_t j = 0; j < space_.columns; ++j) take_off(space_.column(j), x);
  }

  /// M^-1/2 times the forces that static responses are wanted to, each of length 1.
  std::vector<std::vector<double>> static_loads() const {
    std::vector<std::vector<double>> loads;
    if (request_.gravity != Vector3{0, 0, 0}) {
      std::vector<double>& weight = loads.emplace_back(dofs_, 0.0);
      for (std::size_t i = 0; i < dofs_; ++i) {
        const int direction = system_.direction[i];
        if (direction < 0) continue;
        weight[i] = std::sqrt(system_.lumped_mass[i]) * request_.gravity[direction];
      }
      scale(weight, 1 / norm(weight));
    }
    for (const TracePoint& point : request_.contact_points) {
      const LocalIndex dof = mesh_.dof(mesh_.owned_node(point.node), point.component);
      if (dof >= 0 && request_.attachment) loads.emplace_back(dofs_, 0.0)[dof] = 1;
    }
    return loads;
  }

  void add_attachment_vectors() {
    std::vector<std::vector<double>> loads = static_loads();
    if (loads.empty()) return;
    const ShiftedSolver solver(system_, lowest_matrix(), lowest_shift);
    std::vector<std::vector<double>> vectors;
    for (std::vector<double>& z : loads) {
      if (admissible_) admit(z);
      project(z);
      if (norm(z) <= inside_span) continue;
      project(z);
      to_coordinates(z);
      solver.solve(z);
      from_coordinates(z);
      project(z);
      scale(z, 1 / norm(z));
      project(z);
      vectors.push_back(std::move(z));
    }
    orthonormalise(vectors);
  }

  /// Adds the vectors to the space, that with the largest remainder first.
  void orthonormalise(std::vector<std::vector<double>>& vectors) {
    std::vector<std::size_t> left(vectors.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    while (!left.empty()) {
      const auto best = std::max_element(
          left.begin(), left.end(),
          [&](std::size_t a, std::size_t b) { return norm(vectors[a]) < norm(vectors[b]); });
      std::vector<double> z = vectors[*best];
      left.erase(best);
      if (norm(z) <= inside_span) return;
      scale(z, 1 / norm(z));
      project(z);  // once more: what rounding put back grew with the scale
      scale(z, 1 / norm(z));
      space_.append(z);
      for (const std::size_t i : left) take_off(space_.column(space_.columns - 1), vectors[i]);
    }
  }

  /// Rayleigh-Ritz: the basis is W S with W the space and S^T (W^T A W) S diagonal.
  void rotate(ModalBasis& basis) const {
    DenseMatrix product(dofs_, space_.columns);
    for (std::size_t j = 0; j < space_.columns; ++j) multiply(space_.column(j), product.column(j));
    DenseMatrix rotation = transposed_product(space_, product);
    basis.squared_frequency = symmetric_eigenvalues(rotation);
    for (double& value : basis.squared_frequency) value = std::max(value, 0.0);
    find_modes_in(rotation, basis);
    add_participation(rotation, basis);
    add_rows(rotation, basis);
    if (system_.supports) add_supports(rotation, basis);
  }

  /// Modes are vectors of A whatever stands beside them: they come out of the rotation as they went
  /// in, but between vectors that are none.
  void find_modes_in(const DenseMatrix& rotation, ModalBasis& basis) const {
    const std::size_t modes = mode_numbers_.size();
    std::vector<double> share(space_.columns, 0.0);  // of each new vector in the modes' space
    std::vector<std::size_t> order(space_.columns);
    for (std::size_t i = 0; i < space_.columns; ++i) {
      order[i] = i;
      for (std::size_t j = 0; j < modes; ++j) share[i] += std::pow(rotation.column(i)[j], 2);
    }
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return share[i]; });
    order.resize(modes);
    std::ranges::sort(order);
    basis.mode_numbers.assign(space_.columns, 0);
    for (std::size_t j = 0; j < modes; ++j) basis.mode_numbers[order[j]] = mode_numbers_[j];
  }

  void add_participation(const DenseMatrix& rotation, ModalBasis& basis) const {
    const RigidMotions motions(system_, mesh_);
    basis.mass = motions.mass();
    basis.centre_of_mass = motions.centre();
    basis.inertia = motions.inertia();
    DenseMatrix of_space(space_.columns, 6);
    for (std::size_t j = 0; j < space_.columns; ++j) {
      const std::array<double, 6> values = motions.participation(space_.column(j));
      for (std::size_t k = 0; k < 6; ++k) of_space.column(k)[j] = values[k];
    }
    basis.participation = transposed_product(rotation, of_space).values;
  }

  /// After the points are known.
  void add_supports(const DenseMatrix& rotation, ModalBasis& basis) const {
    const SupportShapes& supports = *system_.supports;
    const std::size_t columns = supports.columns.size();
    DenseMatrix of_space(space_.columns, 0);
    for (const std::vector<double>& shape : supports.shape) {
      std::vector<double> scaled = shape;  // M^1/2 iota
      for (std::size_t i = 0; i < scaled.size(); ++i) {
        scaled[i] *= std::sqrt(system_.lumped_mass[i]);
      }
      std::vector<double> parts(space_.columns, 0.0);
      for (std::size_t j = 0; !scaled.empty() && j < parts.size(); ++j) {
        parts[j] = dot(space_.column(j), scaled.data(), dofs_);
      }
      of_space.append(parts);
    }
    basis.support_participation = transposed_product(rotation, of_space).values;
    for (const TracePoint& point : basis.points) {
      const LocalIndex dof = mesh_.dof(mesh_.owned_node(point.node), point.component);
      for (std::size_t c = 0; c < columns; ++c) {
        basis.support_rows.push_back(supports.shape[c].empty() ? 0 : supports.shape[c][dof]);
      }
    }
  }

  void add_rows(const DenseMatrix& rotation, ModalBasis& basis) const {
    DenseMatrix of_space(space_.columns, 0);
    std::set<TracePoint> known;
    for (const auto* points :
         {&request_.contact_points, &request_.other_points, &request_.shown_points}) {
      for (const TracePoint& point : *points) {
        const LocalIndex dof = mesh_.dof(mesh_.owned_node(point.node), point.component);
        if (dof < 0 || !known.insert(point).second) continue;
        const std::size_t i = dof;
        basis.points.push_back(point);
        std::vector<double> row(space_.columns);
        for (std::size_t j = 0; j < row.size(); ++j) {
          row[j] = std::sqrt(system_.inverse_mass[i]) * space_.column(j)[i];
        }
        of_space.append(row);
      }
    }
    basis.rows = transposed_product(rotation, of_space).values;
  }

  const LinearSystem& system_;
  const Mesh& mesh_;
  const ModalRequest& request_;
  MatHandle matrix_;
  std::size_t dofs_;
  std::size_t independent_;                      ///< see LinearSystem::independent_dofs
  std::optional<AdmissibleMotions> admissible_;  ///< of rigid bodies
  MatHandle restricted_;                         ///< A in their coordinates
  double idle_ = 0;                              ///< eigenvalue of what they do not admit [1/s2]
  DenseMatrix space_;
  std::vector<double> squared_frequency_;  ///< of the modes found [1/s2]
  std::vector<int> mode_numbers_;          ///< of the modes in the space, from 1
};

}  // namespace

ModalBasis compute_modal_basis(const LinearSystem& system, const Mesh& mesh,
                               const ModalRequest& request) {
  return BasisMaker(system, mesh, request).make();
}

void broadcast_basis(MPI_Comm comm, int root, ModalBasis& basis) {
  std::array<std::int64_t, 3> counts{basis.modes, basis.attachment_vectors, basis.full_dofs};
  MPI_Bcast(counts.data(), 3, MPI_INT64_T, root, comm);
  basis.modes = static_cast<int>(counts[0]);
  basis.attachment_vectors = static_cast<int>(counts[1]);
  basis.full_dofs = counts[2];
  MPI_Bcast(&basis.total_mass, 1, MPI_DOUBLE, root, comm);
  MPI_Bcast(&basis.mass, 1, MPI_DOUBLE, root, comm);
  MPI_Bcast(basis.centre_of_mass.data(), 3, MPI_DOUBLE, root, comm);
  MPI_Bcast(basis.inertia.data(), 6, MPI_DOUBLE, root, comm);
  broadcast_array(comm, basis.mode_numbers, root);
  broadcast_array(comm, basis.squared_frequency, root);
  broadcast_array(comm, basis.participation, root);
  broadcast_array(comm, basis.points, root);
  broadcast_array(comm, basis.rows, root);
  broadcast_array(comm, basis.support_participation, root);
  broadcast_array(comm, basis.support_rows, root);
}

}  // namespace pounding
