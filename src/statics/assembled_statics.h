#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/petsc.h"
#include "mesh/mesh.h"
#include "scene/scene.h"
#include "statics/unilateral_rows.h"
#include "system/admissible_motions.h"
#include "system/linear_system.h"
#include "system/support_shapes.h"

namespace pounding {

/// Stiffness of a structure against forces that stay: K without one-way links, whatever damps it.
/// It may be singular, as that of a block which only rests on another; K + shift M is not.
class StaticStiffness {
 public:
  virtual ~StaticStiffness() = default;
  /// q = K u over the owned dofs [N, N m]. Collective.
  virtual void apply(const std::vector<double>& u, std::vector<double>& q) const = 0;
  /// x := (K + shift M)^-1 x over the owned dofs. Collective.
  virtual void solve(std::vector<double>& x) const = 0;
  /// How it is solved, for the report.
  virtual std::string method() const = 0;
};

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

/// Static stiffness of a structure, reduced or at full order; that at full order needs
/// LinearSystem::stiffest_matrix. `shift` [1/s2]. Throws UserError naming the structure where the
/// factorisation fails. Collective.
std::unique_ptr<StaticStiffness> make_static_stiffness(const LinearSystem& system, const Mesh& mesh,
                                                       double shift, SolverChoice solver);

/// How a structure at full order follows the columns of its supports: for each that carries it,
///
///     K iota = -K_s w
///
/// by corrections (K + sigma M) d = -(K_s w + K iota), iota <- iota + d, with sigma = 1 / s2, from
/// zero on. K of the linear elements may be singular: parts that they do not hold keep their place,
/// since no support pulls on these. The products are those of the step, so that K iota + K_s w
/// is zero for them to round-off. Where all the ground moves with one support, w is that of
/// the ends of springs in the ground as well, and iota begins as the rigid motion of all nodes: of
/// a displacement it is that. Needs the matrix of the system. Null if the structure is on
/// no support that moves on its own. Throws UserError naming the structure where the corrections do
/// not end. Collective.
std::shared_ptr<SupportShapes> find_support_shapes(const Structure& structure, const Mesh& mesh,
                                                   const LinearSystem& system,
                                                   std::span<const SupportColumn> columns,
                                                   SolverChoice solver);

}  // namespace pounding
