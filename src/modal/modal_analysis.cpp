#include "modal/modal_analysis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/error.h"
#include "common/matrix3.h"
#include "common/parallel.h"
#include "common/types.h"
#include "modal/eigen_solver.h"
#include "modal/shifted_solver.h"
#include "system/admissible_motions.h"

namespace pounding {
namespace {

/// Bound of every circular frequency [rad/s]. Elements with stiffness and no mass, springs, have no
/// bound of their own: then that of the rows of M^-1/2 K M^-1/2, of motions that rigid bodies and
/// ties admit, since their followers may have next to no mass of their own.
double frequency_bound(const LinearSystem& system) {
  if (std::isfinite(system.element_frequency_bound)) return system.element_frequency_bound;
  const MatHandle scaled = system.rigid_bodies.empty()
                               ? mass_scaled(system, system.stiffest_matrix())
                               : AdmissibleMotions(system, AdmissibleMotions::Alone::mass_scaled)
                                     .restrict_matrix(system.stiffest_matrix());
  PetscReal norm = 0;
  POUNDING_PETSC(MatNorm(scaled.get(), NORM_INFINITY, &norm));
  return std::sqrt(norm);
}

/// An eigenpair in the coordinates of the problem that was solved, over the owned dofs.
struct FoundPair {
  double value = 0;  ///< [1/s2]
  std::vector<double> vector;
};

/// Adds the pairs that a solver found of A + `above` B.
void take_pairs(const LinearSystem& system, EPS solver, double above,
                std::vector<FoundPair>& found) {
  PetscInt count = 0;
  POUNDING_PETSC(EPSGetConverged(solver, &count));
  for (PetscInt i = 0; i < count; ++i) {
    FoundPair& pair = found.emplace_back();
    pair.vector.resize(system.lumped_mass.size());
    const VecHandle vector = wrap_vector(system, pair.vector);
    POUNDING_PETSC(EPSGetEigenpair(solver, i, &pair.value, nullptr, vector.get(), nullptr));
    pair.value -= above;
  }
}

/// Number of eigenvalues below a value, by Sylvester's law of inertia.
int eigenvalues_below(const LowestProblem& problem, double value) {
  if (problem.mass == nullptr) {
    return ShiftedSolver(problem.matrix, value).eigenvalues_below();
  }
  MatHandle shifted;
  POUNDING_PETSC(MatDuplicate(problem.matrix, MAT_COPY_VALUES, shifted.out()));
  POUNDING_PETSC(MatAXPY(shifted.get(), -value, problem.mass, DIFFERENT_NONZERO_PATTERN));
  return ShiftedSolver(shifted.get(), 0).eigenvalues_below();
}

/// Seeks the missing ones among the `wanted` lowest pairs: a Krylov space of one vector sees a copy
/// of a frequency by its round-off alone, and may end before. The law of inertia counts the
/// eigenvalues; those that were not seen are found beside the vectors that were. Where these are
/// none, round-off made the count. `zero`: below it eigenvalues are 0 [1/s2]; 0: nothing strains,
/// and there is nothing to count.
void find_missed(const LowestProblem& problem, int wanted, double zero,
                 std::vector<FoundPair>& found) {
  constexpr double same = 1e-7;  // relative difference of two eigenvalues that are one
  while (zero > 0) {
    std::ranges::stable_sort(found, {}, &FoundPair::value);
    const double last = found[static_cast<std::size_t>(wanted) - 1].value;
    const double limit = last + std::max(zero, same * std::abs(last));
    const auto known = static_cast<int>(
        std::ranges::count_if(found, [&](const FoundPair& pair) { return pair.value < limit; }));
    const auto left =
        static_cast<int>(problem.system.independent_dofs()) - static_cast<int>(found.size());
    const int missing = std::min(eigenvalues_below(problem, limit) - known, left);
    if (missing <= 0) return;
    std::vector<VecHandle> vectors;
    for (FoundPair& pair : found) vectors.push_back(wrap_vector(problem.system, pair.vector));
    const std::size_t before = found.size();
    const EpsHandle more = solve_lowest(problem, missing, &vectors);
    vectors.clear();
    take_pairs(problem.system, more.get(), 0, found);
    const bool any = std::any_of(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
                                 [&](const FoundPair& pair) { return pair.value < limit; });
    if (!any) return;
  }
}

template <typename Visit>
void for_each_translation(const Mesh& mesh, Visit&& visit) {
  for_each_owned_dof(mesh, [&](LocalIndex dof, LocalIndex node, int c) {
    if (c < 3) visit(static_cast<std::size_t>(dof), c, mesh.position(node));
  });
}

/// A mode with its shape, if that is kept. Its vector is weighed by the roots of the masses, where
/// these are coupled. Collective.
Mode examine(FoundPair& pair, const LinearSystem& system, const Mesh& mesh,
             const RigidMotions& motions, bool keep_shape) {
  std::vector<double>& field = pair.vector;
  double scaled = system.coupled_mass ? system.coupled_mass->added_product(field.data()) : 0;
  for (const LocalIndex dof : system.condensed) {  // their lent mass
    scaled += system.lumped_mass[dof] * field[dof] * field[dof];
  }
  reduce_over_ranks(system.comm, MPI_SUM, scaled);
  std::vector<double> shape;
  if (keep_shape) shape = field;
  if (system.mass_is_coupled()) {
    scale_by_root_mass(system, field);
  } else {
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] /= std::sqrt(system.lumped_mass[i]);
  }
  Mode mode = describe_mode(pair.value, motions.participation(field.data()), motions.inertia());
  mode.scaled_part = scaled;
  mode.shape = std::move(shape);
  mode.region = busiest_region(mesh, field);
  return mode;
}

}  // namespace

double reference_frequency(const Structure& structure, const ModalResult& modal) {
  for (const Mode& mode : modal.modes) {
    const bool vibrates =
        mode.location.empty() && mode.frequency > near_zero * modal.modes.back().frequency;
    if (vibrates) {
      const double unit = std::pow(10.0, std::floor(std::log10(mode.frequency)) - 5);
      return std::round(mode.frequency / unit) * unit;
    }
  }
  const Mode* first = modal.modes.empty() ? nullptr : &modal.modes.front();
  throw UserError(
      "structure " + structure.name + ": none of its first " + std::to_string(modal.modes.size()) +
      " modes vibrates (0 Hz)" +
      (first != nullptr && !first->location.empty()
           ? ", the first, along " + first->direction + ", moves most at " + first->location
           : "") +
      ": look at its supports (-" + structure.name +
      "_clamp), and at the units of mesh and materials; if that is meant, -" + structure.name +
      "_damping_uniform needs a -" + structure.name + "_damping_reference, or more -modes");
}

Mode describe_mode(double eigenvalue, const std::array<double, 6>& participation,
                   const std::array<double, 6>& inertia) {
  Mode mode;
  mode.frequency = std::sqrt(std::max(0.0, eigenvalue)) / (2 * std::numbers::pi);
  mode.participation = participation;
  for (std::size_t k = 0; k < 6; ++k) {
    mode.effective_modal_mass[k] = participation[k] * participation[k];
    const double fraction = inertia[k] > 0 ? mode.effective_modal_mass[k] / inertia[k] : 0;
    if (fraction > mode.direction_fraction) {
      mode.direction_fraction = fraction;
      mode.direction = motion_names[k];
    }
  }
  return mode;
}

double ModalResult::first_frequency() const {
  for (const Mode& mode : modes) {
    if (mode.location.empty()) return mode.frequency;
  }
  return 0;
}

ModalResult lowest_modes(const LinearSystem& system, const Mesh& mesh, int count, bool keep_shapes,
                         SolverChoice choice) {
  const RigidMotions motions(system, mesh);
  ModalResult result;
  result.mass = motions.mass();
  result.centre_of_mass = motions.centre();
  if (count == 0) return result;
  const bool diagonal_mass = !system.mass_is_coupled();
  std::optional<AdmissibleMotions> admissible;
  MatHandle matrix;
  MatHandle mass;
  if (diagonal_mass) {
    matrix = mass_scaled(system, system.stiffest_matrix());
  } else if (system.rigid_bodies.empty()) {
    POUNDING_PETSC(MatDuplicate(system.stiffest_matrix(), MAT_COPY_VALUES, matrix.out()));
    mass = mass_matrix(system);
  } else {
    admissible.emplace(system, AdmissibleMotions::Alone::as_is);
    const double above = std::pow(2 * frequency_bound(system), 2);
    matrix = admissible->restrict_matrix(system.stiffest_matrix(), above);
    mass = admissible->restrict_matrix(mass_matrix(system).get(), 1);
  }
  const int wanted = static_cast<int>(std::min<GlobalIndex>(count, system.independent_dofs()));
  const double fastest = frequency_bound(system);
  const double bound = std::pow(near_zero * fastest, 2);
  std::vector<FoundPair> found;
  const auto to_coordinates = [&](std::vector<double>& field) {
    if (admissible) admissible->to_coordinates(field);
    if (diagonal_mass) scale_by_root_mass(system, field);
  };
  const LowestProblem problem{system, mesh, matrix.get(), mass.get(), fastest, to_coordinates};
  if (must_iterate(system, matrix.get(), choice)) {
    const LowestPairs pairs = iterate_lowest(problem, wanted);
    result.method = pairs.method;
    take_pairs(system, pairs.solver.get(), pairs.above, found);
  } else {
    take_pairs(system, solve_lowest(problem, wanted).get(), 0, found);
    find_missed(problem, wanted, bound, found);
  }
  for (FoundPair& pair : found) {
    if (admissible) admissible->to_motion(pair.vector);
    result.modes.push_back(examine(pair, system, mesh, motions, keep_shapes));
    if (pair.value < bound) result.modes.back().location = locate_largest(mesh, pair.vector);
    pair.vector = {};
  }
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
  result.modes.resize(wanted);
  return result;
}

LargestFrequency largest_frequency(const LinearSystem& system, const Mesh& mesh,
                                   const EigenvalueEffort& effort) {
  if (system.element_frequency_bound == 0) {  // nothing strains: K is round-off, or zero
    LargestFrequency none;
    none.location = locate_largest(mesh, system.lumped_mass);
    return none;
  }
  const ScaledOperator scaled(system, {{1, &system.stiffest()}});
  Lanczos lanczos(system, mesh, [&scaled](Vec x, Vec y) { scaled.apply(x, y); });
  lanczos.run(effort, "omega_max");
  double square = lanczos.bound();
  refuse_if(!(square >= 0),
            "structure " + system.name + ": no largest frequency, since omega_max^2 comes out as " +
                std::to_string(square) + " 1/s2; look at its materials and matrices");
  // Elements of one shape share a frequency that is good to 1e-7.
  const double elements = system.element_frequency_bound * (1 + 1e-6);
  if (lanczos.excess() > 0) square = std::min(square, elements * elements);
  std::vector<double> vector = lanczos.vector();
  if (system.mass_is_coupled()) {
    scaled.to_motion(vector);
    scale_by_root_mass(system, vector);
  }
  LargestFrequency result;
  result.omega_max = std::sqrt(square);
  result.excess = 1 - std::sqrt(1 - lanczos.excess());
  result.products = lanczos.products();
  result.location = locate_largest(mesh, vector);
  return result;
}

RigidMotions::RigidMotions(const LinearSystem& system, const Mesh& mesh) : system_(system) {
  std::array<double, 4> sums{};
  for_each_translation(mesh, [&](std::size_t dof, int c, const Vector3& x) {
    if (c == 0) {
      const double m = system.lumped_mass[dof];
      sums[0] += m;
      for (std::size_t d = 0; d < 3; ++d) sums[d + 1] += m * x[d];
    }
  });
  reduce_over_ranks(system.comm, MPI_SUM, sums);
  mass_ = sums[0];
  for (std::size_t d = 0; d < 3; ++d) {
    centre_[d] = mass_ > 0 ? sums[d + 1] / mass_ : 0;
    motions_[d] = system.influence(static_cast<int>(d));
    for (std::size_t k = 0; k < system.water.dofs.size(); ++k) {
      const auto i = static_cast<std::size_t>(system.water.dofs[k]);
      motions_[d][i] += system.inverse_mass[i] * system.water.force[d][k];
    }
    motions_[d + 3].assign(system.lumped_mass.size(), 0.0);
  }
  for_each_translation(mesh, [&](std::size_t dof, int c, const Vector3& x) {
    const std::array<double, 6> row =
        rigid_motion_row(static_cast<std::size_t>(c), minus(x, centre_));
    for (std::size_t k = 3; k < 6; ++k) motions_[k][dof] = row[k];
  });
  for (std::size_t k = 0; k < 6; ++k) inertia_[k] = weighted_square(motions_[k]);
  reduce_over_ranks(system.comm, MPI_SUM, inertia_);
}

std::array<double, 6> RigidMotions::participation(const double* y) const {
  std::array<double, 6> sums{};
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < motions_[k].size(); ++i) {
      sums[k] += std::sqrt(system_.lumped_mass[i]) * y[i] * motions_[k][i];
    }
  }
  reduce_over_ranks(system_.comm, MPI_SUM, sums);
  return sums;
}

double RigidMotions::weighted_square(const std::vector<double>& a) const {
  std::vector<double> motion = a;  // of all modes: (M + S)^-1 M a where there is water
  if (!system_.waters().empty()) {
    std::vector<double> momentum = a;
    for (std::size_t i = 0; i < a.size(); ++i) momentum[i] *= system_.lumped_mass[i];
    std::vector<double> field(system_.coupled_mass->field_size());
    system_.coupled_mass->take(momentum.data(), field.data());
    system_.coupled_mass->solve(field.data());
    system_.coupled_mass->put(field.data(), motion.data());
  }
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * motion[i] * system_.lumped_mass[i];
  return sum;
}

}  // namespace pounding
