#include "statics/make_static_stiffness.h"

#include "common/dense_solver.h"
#include "common/error.h"
#include "common/parallel.h"
#include "statics/assembled_statics.h"
#include "statics/link_terms.h"
#include "statics/static_stiffness.h"
#include "system/linear_system.h"

namespace pounding {
namespace {

void multiply(const std::vector<double>& matrix, const std::vector<double>& x,
              std::vector<double>& product) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += matrix[i * n + j] * x[j];
    product[i] = sum;
  }
}

/// Static stiffness of a structure in generalised coordinates, all on one rank: diagonal, but for
/// the one-way links that its K counts as acting and that are taken out here.
class ReducedStatics final : public StaticStiffness {
 public:
  /// Throws UserError if the stiffness without bars is not positive with the shift.
  ReducedStatics(const LinearSystem& system, double shift);
  void apply(const std::vector<double>& u, std::vector<double>& q) const override;
  void solve(std::vector<double>& x) const override;
  std::string method() const override { return "in generalised coordinates"; }

 private:
  std::vector<double> stiffness_;  ///< shape (n, n)
  std::vector<double> inverse_;    ///< of stiffness + shift M, shape (n, n)
};

ReducedStatics::ReducedStatics(const LinearSystem& system, double shift) {
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
    if (n > 0 && !invert_definite(inverse_)) {
      throw UserError("structure " + system.name +
                      ": its reduced stiffness is not positive without its one-way links, so "
                      "it has no static equilibrium; leave -preload out");
    }
  });
}

void ReducedStatics::apply(const std::vector<double>& u, std::vector<double>& q) const {
  q.resize(u.size());
  multiply(stiffness_, u, q);
}

void ReducedStatics::solve(std::vector<double>& x) const {
  const std::vector<double> right = x;
  multiply(inverse_, right, x);
}

}  // namespace

std::unique_ptr<StaticStiffness> make_static_stiffness(const LinearSystem& system, const Mesh& mesh,
                                                       double shift, SolverChoice solver) {
  if (system.generalised) return std::make_unique<ReducedStatics>(system, shift);
  return std::make_unique<AssembledStatics>(system, mesh, shift, solver);
}

}  // namespace pounding
