#include "statics/find_support_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/error.h"
#include "common/parallel.h"
#include "statics/assembled_statics.h"
#include "system/factor_plan.h"

namespace pounding {
namespace {

constexpr double unit_shift = 1;  // 1/s2

/// A correction this small against the solution, by mass, is round-off.
constexpr double round_off = 1e-15;
/// One that is no smaller than the one before is round-off as well, if it is smaller than this.
constexpr double small = 1e-11;

constexpr int most_corrections = 1000;

/// u^T M u over all ranks.
double square(const LinearSystem& system, const std::vector<double>& u) {
  double sum = 0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += system.lumped_mass[i] * u[i] * u[i];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, system.comm);
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

}  // namespace

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
  MPI_Allreduce(MPI_IN_PLACE, stands.data(), static_cast<int>(stands.size()), MPI_INT, MPI_MAX,
                mesh.comm);
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
