#include "modal/modal_analysis.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "common/component_names.h"
#include "common/error.h"
#include "mesh/location.h"
#include "modal/eigen_solver.h"
#include "modal/lowest_iteration.h"
#include "modal/rigid_motions.h"
#include "modal/scaled_operator.h"
#include "system/admissible_motions.h"

namespace pounding {
namespace {

/// M^1/2 x.
void weigh(const LinearSystem& system, std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= std::sqrt(system.lumped_mass[i]);
}

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
  LowestPairs pairs;
  if (must_iterate(system, matrix.get(), choice)) {
    const auto to_coordinates = [&](std::vector<double>& field) {
      if (admissible) admissible->to_coordinates(field);
      if (diagonal_mass) weigh(system, field);
    };
    pairs = iterate_lowest(
        {system, mesh, matrix.get(), mass.get(), frequency_bound(system), to_coordinates}, wanted);
  } else {
    pairs.solver = solve_lowest(system, mesh, matrix.get(), wanted, mass.get());
  }
  result.method = pairs.method;
  PetscInt found = 0;
  POUNDING_PETSC(EPSGetConverged(pairs.solver.get(), &found));
  std::vector<double> storage(system.lumped_mass.size());
  const VecHandle vector = wrap_vector(system, storage);
  const double bound = near_zero * frequency_bound(system);
  for (int i = 0; i < found; ++i) {
    double eigenvalue = 0;
    POUNDING_PETSC(
        EPSGetEigenpair(pairs.solver.get(), i, &eigenvalue, nullptr, vector.get(), nullptr));
    eigenvalue -= pairs.above;
    if (admissible) admissible->to_motion(storage);
    std::vector<double> shape;
    if (keep_shapes) shape = storage;
    if (!diagonal_mass) {
      weigh(system, storage);
    } else {
      std::ranges::transform(
          shape, system.lumped_mass, shape.begin(),
          [](double y, double mass_of_dof) { return y / std::sqrt(mass_of_dof); });
    }
    result.modes.push_back(
        describe_mode(eigenvalue, motions.participation(storage.data()), motions.inertia()));
    result.modes.back().shape = std::move(shape);
    if (eigenvalue < bound * bound) result.modes.back().location = locate_largest(mesh, storage);
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
  Lanczos lanczos(system, mesh, scaled);
  lanczos.run(effort, "omega_max");
  double square = lanczos.bound();
  if (!(square >= 0)) {
    throw UserError("structure " + system.name +
                    ": no largest frequency, since omega_max^2 comes out as " +
                    std::to_string(square) + " 1/s2; look at its materials and matrices");
  }
  // Elements of one shape share a frequency that is good to 1e-7.
  const double elements = system.element_frequency_bound * (1 + 1e-6);
  if (lanczos.excess() > 0) square = std::min(square, elements * elements);
  std::vector<double> vector = lanczos.vector();
  if (system.mass_is_coupled()) {
    scaled.to_motion(vector);
    weigh(system, vector);
  }
  LargestFrequency result;
  result.omega_max = std::sqrt(square);
  result.excess = 1 - std::sqrt(1 - lanczos.excess());
  result.products = lanczos.products();
  result.location = locate_largest(mesh, vector);
  return result;
}

}  // namespace pounding
