#pragma once

#include <functional>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "system/linear_system.h"

namespace pounding {

/// y = A x of vectors x and y over the owned dofs of a structure, A symmetric. Collective.
using SymmetricProduct = std::function<void(Vec x, Vec y)>;

/// Work that the largest eigenvalue of a structure may cost.
struct EigenvalueEffort {
  /// Relative error of a circular frequency that is accepted where 1e-10 costs too much [-].
  double tolerance = 1e-3;
  /// Products times dofs after which that is so; 0: at once, however close it has come.
  double work = 1e8;
  /// Called with the number of products now and then, on all ranks.
  std::function<void(int)> report = [](int) {};
};

/// The largest eigenvalue of a positive semidefinite A = G^-1 B G^-T by Lanczos' three-term
/// recurrence from a random vector, no vector kept:
///
///     A V_k = V_k T_k + beta_k v_{k+1} e_k^T
///
/// The largest eigenvalue theta of T_k approaches that of A from below. Two facts bound the rest:
/// some eigenvalue lies within r = beta_k |s_k| of theta, s the eigenvector of T_k; and for a start
/// vector without preferred direction, whatever the eigenvalues (Kuczynski and Wozniakowski, SIAM
/// J. Matrix Anal. Appl. 13 (1992) 1094, theorem 4.2),
///
///     P{ lambda_max > theta / (1 - e) } <= 1.648 sqrt(n) exp(-sqrt(e) (2 k - 1))
///
/// The start vector is the same for any number of ranks, so that a run can be repeated.
class Lanczos {
 public:
  /// All that is referred to must outlive it. Collective.
  Lanczos(const LinearSystem& system, const Mesh& mesh, SymmetricProduct product);

  /// Iterates until r is 1e-10 of theta and no eigenvalue above (1 + 2e-3) theta can have been
  /// missed but with a probability of 1e-9 (or there are fewer than k / 2 dofs), or, if that takes
  /// more than `effort` allows, until none above (1 + 2 tolerance) theta can. Throws UserError that
  /// `what` of the structure did not converge. Collective.
  void run(const EigenvalueEffort& effort, const char* what);

  /// Upper bound of the largest eigenvalue: theta + r, or theta / (1 - e).
  double bound() const { return bound_; }
  /// e: part of the eigenvalue by which the bound may be too large; 0: r is 1e-10 of theta.
  double excess() const { return excess_; }
  /// Products that it took.
  int products() const { return static_cast<int>(diagonal_.size()); }
  /// A vector y, |y| = 1, over the owned dofs, that is near the eigenvector: its quotient y^T A y
  /// is that of T_k for the first k at which r was small, or for a hundred. Collective.
  std::vector<double> vector();

  /// Part e by which theta may be too small with a probability of 1e-9, at most 1.
  static double missed(GlobalIndex dofs, int products);

 private:
  struct RitzPair {
    double value = 0;
    double residual = 0;
    std::vector<double> vector;  ///< of T_k
  };
  void begin();
  /// One product: v_{k+1} takes the place of v_k.
  void advance(double& diagonal, double& beside);
  RitzPair largest_of(std::size_t k) const;

  const LinearSystem& system_;
  const Mesh& mesh_;
  SymmetricProduct product_;
  VecHandle previous_;
  VecHandle current_;
  VecHandle next_;
  double beta_ = 0;               ///< between previous_ and current_
  std::vector<double> diagonal_;  ///< of T
  std::vector<double> beside_;    ///< beta_k
  std::size_t vector_steps_ = 0;  ///< of T for `vector`
  double bound_ = 0;
  double excess_ = 0;
};

}  // namespace pounding
