#include "modal/lanczos.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <petscblaslapack.h>

#include "common/error.h"
#include "common/repeatable_random.h"

namespace pounding {
namespace {

constexpr double converged_residual = 1e-10;
constexpr double certain_part = 2e-3;  // of the eigenvalue, beyond which none is missed
constexpr double miss_probability = 1e-9;
constexpr std::size_t most_products = 200000;
constexpr double shape_residual = 1e-4;  // enough to locate a mode
constexpr std::size_t shape_products = 100;

double norm(Vec x) {
  double value = 0;
  POUNDING_PETSC(VecNorm(x, NORM_2, &value));
  return value;
}

}  // namespace

Lanczos::Lanczos(const LinearSystem& system, const Mesh& mesh, SymmetricProduct product)
    : system_(system),
      mesh_(mesh),
      product_(std::move(product)),
      previous_(create_vector(system)),
      current_(create_vector(system)),
      next_(create_vector(system)) {}

void Lanczos::begin() {
  double* values = nullptr;
  POUNDING_PETSC(VecSet(previous_.get(), 0));
  POUNDING_PETSC(VecGetArray(current_.get(), &values));
  for_each_owned_dof(mesh_, [&](LocalIndex dof, LocalIndex node, int c) {
    values[dof] = scattered_normal(static_cast<std::uint64_t>(6 * mesh_.file_node[node] + c));
  });
  POUNDING_PETSC(VecRestoreArray(current_.get(), &values));
  POUNDING_PETSC(VecScale(current_.get(), 1 / norm(current_.get())));
  beta_ = 0;
}

void Lanczos::advance(double& diagonal, double& beside) {
  product_(current_.get(), next_.get());
  POUNDING_PETSC(VecAXPY(next_.get(), -beta_, previous_.get()));
  POUNDING_PETSC(VecDot(current_.get(), next_.get(), &diagonal));
  POUNDING_PETSC(VecAXPY(next_.get(), -diagonal, current_.get()));
  // Not from the norm of A v and the diagonal: errors would grow.
  beside = norm(next_.get());
  if (beside > 0) POUNDING_PETSC(VecScale(next_.get(), 1 / beside));
  beta_ = beside;
  std::swap(previous_, current_);
  std::swap(current_, next_);
}

Lanczos::RitzPair Lanczos::largest_of(std::size_t k) const {
  RitzPair pair;
  pair.vector.resize(k);
  const auto n = static_cast<PetscBLASInt>(k);
  PetscBLASInt found = 0;
  PetscBLASInt splits = 0;
  PetscBLASInt failed = 0;
  PetscBLASInt info = 0;
  const PetscReal unused = 0;
  const PetscReal precise = 0;  // as precise as can be
  const PetscBLASInt one = 1;
  std::vector<PetscBLASInt> block(k);
  std::vector<PetscBLASInt> split(k);
  std::vector<PetscBLASInt> integers(3 * k);
  std::vector<double> values(k);
  std::vector<double> work(5 * k);
  LAPACKstebz_("I", "B", &n, &unused, &unused, &n, &n, &precise, diagonal_.data(), beside_.data(),
               &found, &splits, values.data(), block.data(), split.data(), work.data(),
               integers.data(), &info);
  if (info == 0) {
    LAPACKstein_(&n, diagonal_.data(), beside_.data(), &one, values.data(), block.data(),
                 split.data(), pair.vector.data(), &n, work.data(), integers.data(), &failed,
                 &info);
  }
  // Not converged at `info` vectors: the estimate of the residual is then too large, if anything.
  if (info < 0 || found != 1) throw std::runtime_error("LAPACK: no largest eigenvalue");
  pair.value = values[0];
  pair.residual = beside_[k - 1] * std::abs(pair.vector.back());
  return pair;
}

double Lanczos::missed(GlobalIndex dofs, int products) {
  const double logarithm =
      std::log(1.648 * std::sqrt(static_cast<double>(dofs)) / miss_probability);
  return std::min(1.0, std::pow(logarithm / (2 * products - 1), 2));
}

void Lanczos::run(const EigenvalueEffort& effort, const char* what) {
  const auto fail = [&] {
    throw UserError("structure " + system_.name + ": " + what +
                    " did not converge: look at the units of mesh and materials");
  };
  begin();
  RitzPair converged;
  double scale = 0;
  std::size_t next = 1;
  for (std::size_t k = 1;; ++k) {
    double& diagonal = diagonal_.emplace_back();
    double& beside = beside_.emplace_back();
    advance(diagonal, beside);
    if (!std::isfinite(diagonal) || !std::isfinite(beside)) fail();
    scale = std::max(scale, std::abs(diagonal) + beside);
    const bool exhausted = beside <= 1e-14 * scale;
    if (k < next && !exhausted) continue;
    next = k + 1 + k / 8;
    effort.report(static_cast<int>(k));
    RitzPair pair = largest_of(k);
    const double theta = pair.value;
    if (vector_steps_ == 0 && (pair.residual <= shape_residual * std::abs(pair.value) ||
                               exhausted || k >= shape_products)) {
      vector_steps_ = k;
    }
    excess_ = missed(system_.global_dofs, products());
    if (pair.value > converged.value + converged.residual) converged = {};
    if (converged.vector.empty() &&
        (exhausted || pair.residual <= converged_residual * std::abs(pair.value))) {
      converged = std::move(pair);
    }
    // After n products there is nothing left to find, but for round-off.
    const bool certain =
        exhausted || excess_ <= certain_part || products() >= 2 * system_.global_dofs;
    if (!converged.vector.empty() && certain) {
      bound_ = converged.value + converged.residual;
      excess_ = 0;
      return;
    }
    if (static_cast<double>(k) * static_cast<double>(system_.global_dofs) >= effort.work &&
        (converged.vector.empty() || effort.work == 0) && excess_ <= 2 * effort.tolerance) {
      bound_ = theta / (1 - excess_);
      if (vector_steps_ == 0) vector_steps_ = k;
      return;
    }
    if (k > most_products) fail();
  }
}

std::vector<double> Lanczos::vector() {
  const RitzPair pair = largest_of(vector_steps_);
  VecHandle sum;
  POUNDING_PETSC(VecDuplicate(current_.get(), sum.out()));
  POUNDING_PETSC(VecSet(sum.get(), 0));
  begin();
  for (const double part : pair.vector) {
    POUNDING_PETSC(VecAXPY(sum.get(), part, current_.get()));
    double diagonal = 0;
    double beside = 0;
    advance(diagonal, beside);
  }
  POUNDING_PETSC(VecScale(sum.get(), 1 / norm(sum.get())));
  const VecReader reader(sum.get());
  return {reader.data(), reader.data() + system_.owned_dofs()};
}

}  // namespace pounding
