#pragma once

#include <cstdint>
#include <optional>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "statics/link_terms.h"
#include "statics/static_stiffness.h"
#include "system/admissible_motions.h"
#include "system/linear_system.h"

namespace pounding {

/// Static stiffness of a structure at full order. Products are those of the step, so that a rest
/// of theirs is one of the step; solutions come from one L D L^T factorisation (MUMPS)
/// while it fits into the free memory, beyond from conjugate gradients with algebraic multigrid
/// (GAMG) that knows the six rigid motions.
class AssembledStatics final : public StaticStiffness {
 public:
  /// Stiffness that counts: of all that carries at rest, one-way links apart, or of the linear
  /// elements alone.
  enum class Held { at_rest, elements };
  /// Collective. Needs the matrix of the system.
  AssembledStatics(const LinearSystem& system, const Mesh& mesh, double shift, SolverChoice solver,
                   Held held = Held::at_rest);
  void apply(const std::vector<double>& u, std::vector<double>& q) const override;
  void solve(std::vector<double>& x) const override;
  std::string method() const override;

 private:
  /// False, and nothing kept, where the factor would not fit and may be left to the iteration. By
  /// rank 0 alone: a factor that ranks share has other last bits in every run.
  bool factorise(SolverChoice solver);
  void gather();
  /// Rank 0 alone: whether the factor fits, and whether it could be made.
  bool plan_factor(SolverChoice solver);
  bool fill_factor();
  void prepare_iteration(const Mesh& mesh);
  /// x := (K + shift M)^-1 x in the coordinates of rigid bodies, if there are any.
  void solve_restricted(std::vector<double>& x) const;

  const LinearSystem& system_;
  std::optional<AdmissibleMotions> admissible_;  ///< of rigid bodies and ties
  std::vector<LinkTerms> linear_links_;          ///< that would yield
  MatHandle matrix_;                             ///< K + shift M
  MatHandle gathered_;                           ///< all of it on rank 0, null elsewhere
  MatHandle factor_;                             ///< of that; null with the iteration
  bool factorised_ = false;                      ///< there is one, on rank 0
  PetscHandle<VecScatter, VecScatterDestroy> to_zero_;
  VecHandle at_zero_;  ///< whole vectors, of no length elsewhere
  VecHandle solved_;
  KspHandle iteration_;                  ///< null with the factor
  double factor_memory_ = 0;             ///< estimate, all ranks together [B]
  mutable std::int64_t iterations_ = 0;  ///< of all solutions
  mutable std::int64_t solutions_ = 0;
};

}  // namespace pounding
