#include "modal/modal_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "modal/block_krylov.h"
#include "modal/chosen_modes.h"
#include "modal/eigen_solver.h"
#include "modal/modal_analysis.h"
#include "modal/orthonormal_space.h"
#include "modal/shifted_solver.h"
#include "modal/water_coordinates.h"
#include "system/admissible_motions.h"
#include "system/support_shapes.h"

namespace pounding {
namespace {

/// Part of a vector that is left outside a space, at which it counts as inside.
constexpr double inside_span = 1e-8;

/// Relative difference of two eigenvalues that are the same.
constexpr double same_eigenvalue = 1e-7;

/// Makes a basis of orthonormal columns in y = M^1/2 u, or beside water in its coordinates, whose
/// dofs the ranks of the system share out. Collective, all of it.
class BasisMaker {
 public:
  BasisMaker(const LinearSystem& system, const Mesh& mesh, const ModalRequest& request)
      : system_(system),
        mesh_(mesh),
        request_(request),
        water_(system),
        matrix_(mass_scaled(system, system.stiffest_matrix())),
        damping_(request.damping == nullptr
                     ? MatHandle()
                     : mass_scaled(system, request.damping->stiffest_matrix())),
        dofs_(system.lumped_mass.size()),
        independent_(static_cast<std::size_t>(system.independent_dofs())),
        space_(system.comm, dofs_) {
    for (MatHandle* const matrix : {&matrix_, &damping_}) water_.restrict_matrix(*matrix);
    if (system.rigid_bodies.empty()) return;
    admissible_.emplace(system, AdmissibleMotions::Alone::mass_scaled);
    idle_ = idle_value();
    restricted_ = admissible_->restrict_matrix(system.stiffest_matrix(), idle_);
    water_.restrict_matrix(restricted_);
  }

  ModalBasis make() {
    ModalBasis basis;
    const std::size_t wanted = wanted_modes();
    add_modes(
        std::max(wanted, std::min(static_cast<std::size_t>(request_.candidates), independent_)));
    if (request_.candidates > request_.modes) choose_modes(wanted);
    basis.modes = static_cast<int>(space_.size());
    basis.independent_dofs = static_cast<GlobalIndex>(independent_);
    DenseMatrix responses(dofs_, 0);
    DenseMatrix to_ground(dofs_, 0);
    if (space_.size() < independent_) {
      responses = static_responses(static_loads(system_, mesh_, request_));
      if (request_.residual) to_ground = static_responses(ground_loads(system_));
    }
    solver_.reset();  // before the space grows: no other array is as large as the factor
    add_vectors(responses);
    basis.attachment_vectors = static_cast<int>(space_.size()) - basis.modes;
    space_.normalise(to_ground);
    space_.project(to_ground);
    drop_the_short(to_ground);  // responses that attachment vectors have already
    add_vectors(to_ground);
    basis.residual_vectors =
        static_cast<int>(space_.size()) - basis.modes - basis.attachment_vectors;
    basis.full_dofs = system_.global_dofs;
    basis.total_mass = system_.total_mass;
    rotate(basis);
    return basis;
  }

 private:
  std::size_t wanted_modes() const {
    if (request_.modes > 0) return std::min(static_cast<std::size_t>(request_.modes), independent_);
    const double omega = 2 * std::numbers::pi * request_.cutoff;
    const int below = ShiftedSolver(lowest_matrix(), omega * omega).eigenvalues_below();
    refuse_if(below == 0, sentence("option -{}_modal_cutoff {} Hz: no mode of the structure lies "
                                   "below it; give a higher one",
                                   {system_.name, request_.cutoff}));
    return static_cast<std::size_t>(std::min(below, request_.most_modes));
  }

  /// Matrix that has the modes' frequencies, in y or in the coordinates z of rigid bodies.
  Mat lowest_matrix() const { return admissible_ ? restricted_.get() : matrix_.get(); }

  /// Factor of that matrix less a shift just below zero, made once.
  const ShiftedSolver& lowest_solver() {
    if (!solver_) solver_.emplace(lowest_matrix(), lowest_shift);
    return *solver_;
  }

  /// Beyond every frequency [1/s2].
  double idle_value() const {
    PetscReal norm = 0;
    POUNDING_PETSC(MatNorm(matrix_.get(), NORM_INFINITY, &norm));
    return 2 * norm;
  }

  /// Changes every column of a matrix, where there are rigid bodies.
  template <typename Change>
  void change_columns(DenseMatrix& x, const Change& change) const {
    for (std::size_t j = 0; admissible_ && j < x.columns; ++j) {
      std::vector<double> column(x.column(j), x.column(j) + dofs_);
      change(column);
      std::ranges::copy(column, x.column(j));
    }
  }

  /// y of z, and z of forces on y: y = M^1/2 T z with orthonormal columns.
  void from_coordinates(std::vector<double>& z) const {
    if (!admissible_) return;
    admissible_->to_motion(z);
    scale_by_root_mass(system_, z);
  }
  void to_coordinates(std::vector<double>& y) const {
    if (!admissible_) return;
    scale_by_root_mass(system_, y);
    admissible_->to_coordinates_of_force(y);
  }
  /// Takes out of y the part that no rigid body admits.
  void admit(std::vector<double>& y) const {
    to_coordinates(y);
    from_coordinates(y);
  }

  /// A x; motions that rigid bodies do not admit have eigenvalues beyond all others.
  void multiply(const MatHandle& matrix, const double* x, double* product) const {
    std::vector<double> from(x, x + dofs_);
    admit(from);
    std::vector<double> to(dofs_);
    const VecHandle argument = wrap_vector(system_, from);
    const VecHandle result = wrap_vector(system_, to);
    POUNDING_PETSC(MatMult(matrix.get(), argument.get(), result.get()));
    admit(to);
    for (std::size_t i = 0; admissible_ && i < dofs_; ++i) to[i] += idle_ * (x[i] - from[i]);
    std::copy(to.begin(), to.end(), product);
  }

  /// All eigenpairs of A as a full matrix, which every rank has, by their values; of vectors the
  /// own rows.
  void decompose(std::vector<double>& values, DenseMatrix& vectors) const {
    const auto size = static_cast<std::size_t>(system_.global_dofs);
    const PetscInt first = first_row(matrix_.get());
    DenseMatrix whole(size, size);
    std::vector<double> unit(dofs_, 0.0);
    for (std::size_t j = 0; j < size; ++j) {
      const std::size_t own = j - static_cast<std::size_t>(first);
      if (own < dofs_) unit[own] = 1;
      multiply(matrix_, unit.data(), whole.column(j) + first);
      if (own < dofs_) unit[own] = 0;
    }
    reduce_over_ranks(system_.comm, MPI_SUM, whole.values);
    values = symmetric_eigenvalues(whole);
    broadcast_array(system_.comm, whole.values);
    broadcast_array(system_.comm, values);
    for (std::size_t j = 0; j < size; ++j) {
      vectors.append({whole.column(j) + first, dofs_});
    }
  }

  void add_modes(std::size_t wanted) {
    std::vector<double> values;
    DenseMatrix vectors(dofs_, 0);
    if (static_cast<std::size_t>(system_.global_dofs) <=
        largest_krylov_space(wanted + looked_past)) {
      decompose(values, vectors);
    } else {
      find_modes(wanted, values, vectors);
    }
    const double end = values[wanted - 1] + same_eigenvalue * std::abs(values[wanted - 1]);
    while (values.size() > wanted && values.back() > end) values.pop_back();
    squared_frequency_ = std::move(values);
    mode_numbers_.resize(squared_frequency_.size());
    std::iota(mode_numbers_.begin(), mode_numbers_.end(), 1);
    space_.replace(std::move(vectors));
    space_.keep_first(mode_numbers_.size());
  }

  /// Keeps so many of the candidates that are the space so far.
  void choose_modes(std::size_t wanted) {
    const std::vector<std::size_t> order =
        moving_most(system_.comm, mesh_, request_, space_, squared_frequency_, wanted);
    std::vector<int> numbers;
    for (const std::size_t j : order) numbers.push_back(mode_numbers_[j]);
    space_.choose(order);
    mode_numbers_ = std::move(numbers);
  }

  void find_modes(std::size_t wanted, std::vector<double>& values, DenseMatrix& vectors) {
    const std::size_t sought = std::min(wanted + looked_past, independent_);
    Eigenpairs pairs = lowest_eigenpairs(system_, mesh_, lowest_solver(), sought);
    change_columns(pairs.vectors, [this](auto& z) { from_coordinates(z); });
    values = std::move(pairs.values);
    vectors = std::move(pairs.vectors);
  }

  /// Takes out the columns that are nothing but round-off.
  void drop_the_short(DenseMatrix& x) const {
    const std::vector<double> lengths = space_.norms(x);
    for (std::size_t j = x.columns; j-- > 0;) {
      if (lengths[j] <= inside_span) x.remove(j);
    }
  }

  /// Static responses to forces M^1/2 f, without their part in the modes.
  DenseMatrix static_responses(DenseMatrix z) {
    water_.from_force(z);
    space_.normalise(z);
    if (z.columns == 0) return z;
    change_columns(z, [this](auto& y) { admit(y); });
    space_.project(z);
    drop_the_short(z);
    space_.project(z);
    change_columns(z, [this](auto& y) { to_coordinates(y); });
    lowest_solver().solve(z);
    change_columns(z, [this](auto& y) { from_coordinates(y); });
    return z;
  }

  /// Uses the responses up.
  void add_vectors(DenseMatrix& responses) {
    space_.project(responses);
    space_.normalise(responses);
    space_.project(responses);
    space_.reserve(space_.size() + responses.columns);
    space_.take_in(responses, inside_span);
  }

  /// Rayleigh-Ritz: the basis is W S with W the space and S^T (W^T A W) S diagonal.
  void rotate(ModalBasis& basis) {
    DenseMatrix rotation = projected_matrix(matrix_);
    describe_residual_vectors(rotation, basis);
    basis.squared_frequency = symmetric_eigenvalues(rotation);
    for (double& value : basis.squared_frequency) value = std::max(value, 0.0);
    if (damping_.get() != nullptr) add_damping_weights(rotation, basis);
    find_modes_in(rotation, basis);
    DenseMatrix columns = space_.release();
    water_.to_scaled(columns);
    space_.replace(std::move(columns));
    add_participation(rotation, basis);
    add_rows(rotation, basis);
    const auto parts = [&](const DenseMatrix& fields) {
      return transposed_product(rotation, space_.parts(fields)).numbers();
    };
    if (system_.loads) basis.load_parts = parts(scaled_loads(system_));
    if (system_.start) basis.start_parts = parts(scaled_start(system_));
    if (!system_.supports) return;
    basis.support_participation = parts(support_loads(system_));
    add_support_rows(basis);
  }

  /// Rayleigh quotients of residual vectors, and the largest eigenvalue of the space without them.
  /// They are the last of the space.
  void describe_residual_vectors(const DenseMatrix& projected, ModalBasis& basis) const {
    const std::size_t others = space_.size() - static_cast<std::size_t>(basis.residual_vectors);
    for (std::size_t j = others; j < space_.size(); ++j) {
      basis.residual_squared_frequency.push_back(projected.column(j)[j]);
    }
    if (others == space_.size()) return;
    DenseMatrix part(others, 0);
    for (std::size_t j = 0; j < others; ++j) part.append({projected.column(j), others});
    basis.largest_without_residual = symmetric_eigenvalues(part).back();
  }

  /// W^T A W of A or another matrix.
  DenseMatrix projected_matrix(const MatHandle& matrix) const {
    constexpr std::size_t portion = 32;  // columns at a time
    DenseMatrix projected(space_.size(), 0);
    for (std::size_t first = 0; first < space_.size(); first += portion) {
      DenseMatrix product(dofs_, std::min(portion, space_.size() - first));
      for (std::size_t j = 0; j < product.columns; ++j) {
        multiply(matrix, space_.column(first + j), product.column(j));
      }
      projected.append_columns(space_.parts(product));
    }
    return projected;
  }

  void add_damping_weights(const DenseMatrix& rotation, ModalBasis& basis) const {
    const DenseMatrix rotated = transposed_product(projected_matrix(damping_), rotation);
    for (std::size_t i = 0; i < basis.size(); ++i) {
      double energy = 0;
      for (std::size_t j = 0; j < basis.size(); ++j) {
        energy += rotation.column(i)[j] * rotated.column(i)[j];
      }
      const double whole = basis.squared_frequency[i];
      basis.damping_weights.push_back(whole > 0 ? 2 * energy / whole - 1 : 1);
    }
  }

  /// Modes are vectors of A whatever the others are: they come out of the rotation as they went in,
  /// but between vectors that are none.
  void find_modes_in(const DenseMatrix& rotation, ModalBasis& basis) const {
    const std::size_t modes = mode_numbers_.size();
    std::vector<double> share(space_.size(), 0.0);  // of each new vector in the modes' space
    std::vector<std::size_t> order(space_.size());
    for (std::size_t i = 0; i < space_.size(); ++i) {
      order[i] = i;
      for (std::size_t j = 0; j < modes; ++j) share[i] += std::pow(rotation.column(i)[j], 2);
    }
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return share[i]; });
    order.resize(modes);
    std::ranges::sort(order);
    basis.mode_numbers.assign(space_.size(), 0);
    for (std::size_t j = 0; j < modes; ++j) basis.mode_numbers[order[j]] = mode_numbers_[j];
  }

  void add_participation(const DenseMatrix& rotation, ModalBasis& basis) const {
    const RigidMotions motions(system_, mesh_);
    basis.mass = motions.mass();
    basis.centre_of_mass = motions.centre();
    basis.inertia = motions.inertia();
    DenseMatrix of_space(space_.size(), 6);
    for (std::size_t j = 0; j < space_.size(); ++j) {
      const std::array<double, 6> values = motions.participation(space_.column(j));
      for (std::size_t k = 0; k < 6; ++k) of_space.column(k)[j] = values[k];
    }
    basis.participation = transposed_product(rotation, of_space).numbers();
  }

  /// Motion of the points with the supports, after the points are known.
  void add_support_rows(ModalBasis& basis) const {
    const SupportShapes& supports = *system_.supports;
    const std::size_t columns = supports.columns.size();
    basis.support_rows.assign(columns * basis.points.size(), 0.0);
    for (std::size_t p = 0; p < basis.points.size(); ++p) {
      const LocalIndex dof = mesh_.owned_dof(basis.points[p].node, basis.points[p].component);
      for (std::size_t c = 0; dof >= 0 && c < columns; ++c) {
        const std::vector<double>& shape = supports.shape[c];
        if (!shape.empty()) basis.support_rows[p * columns + c] = shape[dof];
      }
    }
    reduce_over_ranks(system_.comm, MPI_SUM, basis.support_rows);
  }

  void add_rows(const DenseMatrix& rotation, ModalBasis& basis) const {
    std::set<TracePoint> known;
    for (const auto* points : {&request_.contact_points, &request_.yielding_points,
                               &request_.other_points, &request_.shown_points}) {
      for (const TracePoint& point : free_points(system_.comm, mesh_, *points)) {
        if (known.insert(point).second) basis.points.push_back(point);
      }
    }
    DenseMatrix of_space(space_.size(), basis.points.size());
    for (std::size_t p = 0; p < basis.points.size(); ++p) {
      const LocalIndex dof = mesh_.owned_dof(basis.points[p].node, basis.points[p].component);
      for (std::size_t j = 0; dof >= 0 && j < space_.size(); ++j) {
        of_space.column(p)[j] = std::sqrt(system_.inverse_mass[dof]) * space_.column(j)[dof];
      }
    }
    reduce_over_ranks(system_.comm, MPI_SUM, of_space.values);
    basis.rows = transposed_product(rotation, of_space).numbers();
  }

  const LinearSystem& system_;
  const Mesh& mesh_;
  const ModalRequest& request_;
  WaterCoordinates water_;
  MatHandle matrix_;
  MatHandle damping_;  ///< see ModalRequest::damping
  std::size_t dofs_;
  std::size_t independent_;                      ///< see LinearSystem::independent_dofs
  std::optional<AdmissibleMotions> admissible_;  ///< of rigid bodies
  MatHandle restricted_;                         ///< A in their coordinates
  double idle_ = 0;  ///< eigenvalue of motions that they do not admit [1/s2]
  std::optional<ShiftedSolver> solver_;
  OrthonormalSpace space_;
  std::vector<double> squared_frequency_;  ///< of the modes found [1/s2]
  std::vector<int> mode_numbers_;          ///< of the modes in the space, from 1
};

}  // namespace

ModalBasis compute_modal_basis(const LinearSystem& system, const Mesh& mesh,
                               const ModalRequest& request) {
  return BasisMaker(system, mesh, request).make();
}

}  // namespace pounding
