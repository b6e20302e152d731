#include "statics/assembled_statics.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/dense_matrix.h"
#include "common/error.h"
#include "common/facts.h"
#include "common/parallel.h"
#include "system/factor_plan.h"
#include "system/law_forces.h"

namespace pounding {
namespace {

constexpr double iteration_tolerance = 1e-10;
/// PETSc options of the solvers begin with it.
constexpr const char* prefix = "rest_";
constexpr int most_iterations = 20000;

/// Adds links to a matrix, `sign` times each.
void add_links(std::span<const LinkTerms> links, double sign, PetscInt first_dof, Mat matrix) {
  std::vector<PetscInt> places;
  std::vector<double> values;
  for (const LinkTerms& bar : links) {
    places.clear();
    values.clear();
    for (std::size_t a = 0; a < bar.dofs.size(); ++a) {
      places.push_back(first_dof + bar.dofs[a]);
      for (std::size_t b = 0; b < bar.dofs.size(); ++b) {
        values.push_back(sign * bar.stiffness * bar.coefficients[a] * bar.coefficients[b]);
      }
    }
    const auto n = static_cast<PetscInt>(places.size());
    POUNDING_PETSC(
        MatSetValues(matrix, n, places.data(), n, places.data(), values.data(), ADD_VALUES));
  }
  assemble(matrix);
}

void multiply(const std::vector<double>& matrix, const std::vector<double>& x,
              std::vector<double>& product) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += matrix[i * n + j] * x[j];
    product[i] = sum;
  }
}

constexpr double unit_shift = 1;  // 1/s2

/// A correction this small against the solution, by mass, is round-off.
constexpr double round_off = 1e-15;
/// One that is no smaller than the one before is round-off as well, if it is smaller than this.
constexpr double small = 1e-9;

constexpr int most_corrections = 1000;

/// u^T M u over all ranks.
double square(const LinearSystem& system, const std::vector<double>& u) {
  double sum = 0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += system.lumped_mass[i] * u[i] * u[i];
  reduce_over_ranks(system.comm, MPI_SUM, sum);
  return sum;
}

/// Solves K u = -force, from a first guess on.
std::vector<double> follow(const LinearSystem& system, const AssembledStatics& statics,
                           const std::vector<double>& force, std::vector<double> u) {
  std::vector<double> correction;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_corrections; ++i) {
    statics.apply(u, correction);
    for (std::size_t k = 0; k < u.size(); ++k) correction[k] = -(correction[k] + force[k]);
    statics.solve(correction);
    const double size = std::sqrt(square(system, correction));
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += correction[k];
    const double all = std::sqrt(square(system, u));
    if (size <= round_off * all || (size >= before && size <= small * all)) return u;
    before = size;
  }
  throw UserError(
      "structure " + system.name + ": how it follows its supports at rest is not found after " +
      std::to_string(most_corrections) +
      " corrections; is part of it held by almost nothing, or are mesh and materials in other "
      "units than m, kg and Pa?");
}

/// Static stiffness of a structure in generalised coordinates, all on one rank: diagonal, but for
/// the one-way links that its K counts as acting and that are taken out here.
class ReducedStatics final : public StaticStiffness {
 public:
  /// Throws UserError if the stiffness without bars is not positive with the shift.
  ReducedStatics(const LinearSystem& system, double shift) {
    const std::size_t n = system.lumped_mass.size();
    // K is diagonal: one product gives it.
    const std::vector<double> ones(n, 1.0);
    std::vector<double> diagonal(n, 0.0);
    stiffness::StoredForces store(diagonal.data());
    system.stiffness->apply({ones.data(), ones.data(), 0}, store);
    stiffness_.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) stiffness_[i * n + i] = diagonal[i];
    for (const LinkTerms& bar : link_terms(system)) {
      if (!bar.one_way) continue;  // K holds it, and it does not yield at rest
      for (std::size_t a = 0; a < bar.dofs.size(); ++a) {
        for (std::size_t b = 0; b < bar.dofs.size(); ++b) {
          const std::size_t i = bar.dofs[a];
          const std::size_t j = bar.dofs[b];
          stiffness_[i * n + j] -= bar.stiffness * bar.coefficients[a] * bar.coefficients[b];
        }
      }
    }
    inverse_ = stiffness_;
    for (std::size_t i = 0; i < n; ++i) inverse_[i * n + i] += shift * system.lumped_mass[i];
    on_every_rank(system.comm, [&] {
      refuse_if(n > 0 && !invert_definite(inverse_),
                "structure " + system.name +
                    ": its reduced stiffness is not positive without its one-way links, so "
                    "it has no static equilibrium; leave -preload out");
    });
  }

  void apply(const std::vector<double>& u, std::vector<double>& q) const override {
    q.resize(u.size());
    multiply(stiffness_, u, q);
  }

  void solve(std::vector<double>& x) const override {
    const std::vector<double> right = x;
    multiply(inverse_, right, x);
  }

  std::string method() const override { return "in generalised coordinates"; }

 private:
  std::vector<double> stiffness_;  ///< shape (n, n)
  std::vector<double> inverse_;    ///< of stiffness + shift M, shape (n, n)
};

}  // namespace

AssembledStatics::AssembledStatics(const LinearSystem& system, const Mesh& mesh, double shift,
                                   SolverChoice solver, Held held)
    : system_(system) {
  POUNDING_PETSC(MatDuplicate(system.stiffest_matrix(), MAT_COPY_VALUES, matrix_.out()));
  POUNDING_PETSC(MatSetOptionsPrefixFactor(matrix_.get(), prefix));
  const PetscInt first = first_row(matrix_.get());
  if (system.links) {
    // The stiffest matrix has them at their stiffest.
    const auto carries = [&](const LinkTerms& link) {
      return held == Held::at_rest && !link.one_way;
    };
    std::vector<LinkTerms> others = link_terms(system);
    std::ranges::copy_if(others, std::back_inserter(linear_links_), carries);
    std::erase_if(others, carries);
    add_links(others, -1, first, matrix_.get());
  }
  if (held == Held::elements && system.has_laws_beside) {
    add_law_stiffness(system, mesh, -1, matrix_.get());
    assemble(matrix_.get());
  }
  std::vector<double> added = system.lumped_mass;
  for (double& value : added) value *= shift;
  const VecHandle diagonal = wrap_vector(system, added);
  POUNDING_PETSC(MatDiagonalSet(matrix_.get(), diagonal.get(), ADD_VALUES));
  if (!system.rigid_bodies.empty()) {
    admissible_.emplace(system, AdmissibleMotions::Alone::as_is);
    matrix_ = admissible_->restrict_matrix(matrix_.get());
    POUNDING_PETSC(MatSetOptionsPrefixFactor(matrix_.get(), prefix));
  }
  POUNDING_PETSC(MatSetOption(matrix_.get(), MAT_SYMMETRIC, PETSC_TRUE));
  POUNDING_PETSC(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE));
  if (solver == SolverChoice::iterative || !factorise(solver)) prepare_iteration(mesh);
}

/// Copies the matrix to rank 0. Collective.
void AssembledStatics::gather() {
  const bool here = rank_of(system_.comm) == 0;
  PetscInt rows = 0;
  POUNDING_PETSC(MatGetSize(matrix_.get(), &rows, nullptr));
  PetscHandle<IS, ISDestroy> all;
  POUNDING_PETSC(ISCreateStride(PETSC_COMM_SELF, here ? rows : 0, 0, 1, all.out()));
  IS set = all.get();
  Mat* copies = nullptr;
  POUNDING_PETSC(
      MatCreateSubMatrices(matrix_.get(), here ? 1 : 0, &set, &set, MAT_INITIAL_MATRIX, &copies));
  if (here) {
    POUNDING_PETSC(PetscObjectReference(reinterpret_cast<PetscObject>(copies[0])));
    *gathered_.out() = copies[0];
    POUNDING_PETSC(MatSetOptionsPrefixFactor(gathered_.get(), prefix));
    POUNDING_PETSC(MatSetOption(gathered_.get(), MAT_SYMMETRIC, PETSC_TRUE));
    POUNDING_PETSC(MatSetOption(gathered_.get(), MAT_SPD, PETSC_TRUE));
  }
  POUNDING_PETSC(MatDestroySubMatrices(here ? 1 : 0, &copies));
  VecHandle example;
  POUNDING_PETSC(MatCreateVecs(matrix_.get(), example.out(), nullptr));
  POUNDING_PETSC(VecScatterCreateToZero(example.get(), to_zero_.out(), at_zero_.out()));
  POUNDING_PETSC(VecDuplicate(at_zero_.get(), solved_.out()));
}

bool AssembledStatics::factorise(SolverChoice solver) {
  gather();
  enum class Outcome { done, too_large, failed };
  auto outcome = Outcome::done;
  on_every_rank(system_.comm, [&] {
    if (gathered_.get() == nullptr) return;
    if (!plan_factor(solver)) {
      outcome = Outcome::too_large;
    } else if (!fill_factor()) {
      outcome = Outcome::failed;
    }
  });
  MPI_Bcast(&outcome, 1, MPI_INT, 0, system_.comm);
  MPI_Bcast(&factor_memory_, 1, MPI_DOUBLE, 0, system_.comm);
  refuse_if(outcome == Outcome::failed,
            "structure " + system_.name +
                ": MUMPS cannot factorise its stiffness for the static equilibrium; give "
                "-preload_solver iterative");
  if (outcome == Outcome::too_large) {
    factor_ = MatHandle();
    gathered_ = MatHandle();
  }
  factorised_ = outcome == Outcome::done;
  return factorised_;
}

bool AssembledStatics::plan_factor(SolverChoice solver) {
  constexpr int workspace = 50;  // per cent
  FactorPlan plan = pounding::plan_factor(gathered_.get(), workspace);
  factor_ = std::move(plan.factor);
  factor_memory_ = plan.memory;
  return solver != SolverChoice::automatic || factor_memory_ <= memory_for_factor();
}

bool AssembledStatics::fill_factor() {
  MatFactorInfo info;
  POUNDING_PETSC(MatFactorInfoInitialize(&info));
  POUNDING_PETSC(MatCholeskyFactorNumeric(factor_.get(), gathered_.get(), &info));
  MatFactorError error = MAT_FACTOR_NOERROR;
  POUNDING_PETSC(MatFactorGetError(factor_.get(), &error));
  return error == MAT_FACTOR_NOERROR;
}

void AssembledStatics::prepare_iteration(const Mesh& mesh) {
  set_near_null_space(system_, mesh, matrix_.get(), [&](std::vector<double>& field) {
    if (admissible_) admissible_->to_coordinates(field);
  });
  POUNDING_PETSC(KSPCreate(system_.comm, iteration_.out()));
  POUNDING_PETSC(KSPSetOptionsPrefix(iteration_.get(), prefix));
  POUNDING_PETSC(KSPSetType(iteration_.get(), KSPCG));
  PC preconditioner = nullptr;
  POUNDING_PETSC(KSPGetPC(iteration_.get(), &preconditioner));
  POUNDING_PETSC(PCSetType(preconditioner, PCGAMG));
  POUNDING_PETSC(KSPSetTolerances(iteration_.get(), iteration_tolerance, PETSC_DEFAULT,
                                  PETSC_DEFAULT, most_iterations));
  POUNDING_PETSC(KSPSetOperators(iteration_.get(), matrix_.get(), matrix_.get()));
  POUNDING_PETSC(KSPSetFromOptions(iteration_.get()));
  POUNDING_PETSC(KSPSetUp(iteration_.get()));
}

void AssembledStatics::apply(const std::vector<double>& u, std::vector<double>& q) const {
  q.resize(u.size());
  stiffness::StoredForces store(q.data());
  system_.stiffness->apply({u.data(), u.data(), 0}, store);
  for (const LinkTerms& link : linear_links_) {
    const double force = link.stiffness * link.elongation(u);
    for (std::size_t k = 0; k < link.dofs.size(); ++k) {
      q[link.dofs[k]] += force * link.coefficients[k];
    }
  }
}

void AssembledStatics::solve(std::vector<double>& x) const {
  if (admissible_) admissible_->to_coordinates_of_force(x);
  solve_restricted(x);
  if (admissible_) admissible_->to_motion(x);
}

void AssembledStatics::solve_restricted(std::vector<double>& x) const {
  const VecHandle right = wrap_vector(system_, x);
  VecHandle solution;
  POUNDING_PETSC(VecDuplicate(right.get(), solution.out()));
  ++solutions_;
  if (factorised_) {
    const auto carry = [&](Vec from, Vec to, ScatterMode mode) {
      POUNDING_PETSC(VecScatterBegin(to_zero_.get(), from, to, INSERT_VALUES, mode));
      POUNDING_PETSC(VecScatterEnd(to_zero_.get(), from, to, INSERT_VALUES, mode));
    };
    carry(right.get(), at_zero_.get(), SCATTER_FORWARD);
    if (factor_.get() != nullptr) {
      POUNDING_PETSC(MatSolve(factor_.get(), at_zero_.get(), solved_.get()));
    }
    carry(solved_.get(), solution.get(), SCATTER_REVERSE);
  } else {
    POUNDING_PETSC(KSPSolve(iteration_.get(), right.get(), solution.get()));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt count = 0;
    POUNDING_PETSC(KSPGetConvergedReason(iteration_.get(), &reason));
    POUNDING_PETSC(KSPGetIterationNumber(iteration_.get(), &count));
    iterations_ += count;
    if (reason < 0) {
      throw UserError("structure " + system_.name + ": the iteration for the static equilibrium " +
                      "does not converge after " + std::to_string(count) +
                      " products (PETSc's reason " + std::to_string(reason) +
                      "); give -preload_solver direct, or another -rest_ksp_max_it");
    }
  }
  POUNDING_PETSC(VecCopy(solution.get(), right.get()));
}

std::string AssembledStatics::method() const {
  if (factorised_) return sentence("factorised, {:.3g MB}", {factor_memory_});
  return sentence("conjugate gradients with multigrid, {} products for {} solutions",
                  {iterations_, solutions_});
}

std::unique_ptr<StaticStiffness> make_static_stiffness(const LinearSystem& system, const Mesh& mesh,
                                                       double shift, SolverChoice solver) {
  if (system.generalised) return std::make_unique<ReducedStatics>(system, shift);
  return std::make_unique<AssembledStatics>(system, mesh, shift, solver);
}

std::shared_ptr<SupportShapes> find_support_shapes(const Structure& structure, const Mesh& mesh,
                                                   const LinearSystem& system,
                                                   std::span<const SupportColumn> columns,
                                                   SolverChoice solver) {
  auto shapes = std::make_shared<SupportShapes>();
  shapes->columns.assign(columns.begin(), columns.end());
  std::vector<int> stands(columns.size(), 0);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    stands[c] = mesh.ground_support == columns[c].support ||
                std::ranges::count(mesh.supported, columns[c].support, &SupportedNode::support) > 0;
  }
  reduce_over_ranks(mesh.comm, MPI_MAX, stands);
  if (std::ranges::count(stands, 1) == 0) return nullptr;
  std::optional<AssembledStatics> statics;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double>& shape = shapes->shape.emplace_back();
    if (stands[c] == 0) continue;
    if (mesh.ground_support >= 0) {
      shape = rigid_motion(mesh, columns[c].component, columns[c].point);
      if (columns[c].component < 3) continue;  // nodes and ground displaced alike: no strain
    } else {
      shape.assign(static_cast<std::size_t>(mesh.owned_dofs), 0.0);
    }
    if (!statics) {
      statics.emplace(system, mesh, unit_shift, solver, AssembledStatics::Held::elements);
    }
    std::vector<double> force;
    on_every_rank(mesh.comm, [&] { force = support_force(structure, mesh, columns[c]); });
    shape = follow(system, *statics, force, std::move(shape));
  }
  return shapes;
}

}  // namespace pounding
