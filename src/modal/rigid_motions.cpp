#include "modal/rigid_motions.h"

#include <cmath>

#include "common/rigid_motion.h"

namespace pounding {
namespace {

template <typename Visit>
void for_each_translation(const Mesh& mesh, Visit&& visit) {
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int c = 0; c < 3; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0) visit(static_cast<std::size_t>(dof), c, mesh.position(node));
    }
  }
}

}  // namespace

RigidMotions::RigidMotions(const LinearSystem& system, const Mesh& mesh) : system_(system) {
  std::array<double, 4> sums{};
  for_each_translation(mesh, [&](std::size_t dof, int c, const Vector3& x) {
    if (c == 0) {
      const double m = system.lumped_mass[dof];
      sums[0] += m;
      for (std::size_t d = 0; d < 3; ++d) sums[d + 1] += m * x[d];
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 4, MPI_DOUBLE, MPI_SUM, system.comm);
  mass_ = sums[0];
  for (std::size_t d = 0; d < 3; ++d) {
    centre_[d] = mass_ > 0 ? sums[d + 1] / mass_ : 0;
    motions_[d] = system.influence(static_cast<int>(d));
    motions_[d + 3].assign(system.lumped_mass.size(), 0.0);
  }
  for_each_translation(mesh, [&](std::size_t dof, int c, const Vector3& x) {
    const Vector3 arm{x[0] - centre_[0], x[1] - centre_[1], x[2] - centre_[2]};
    const std::array<double, 6> row = rigid_motion_row(static_cast<std::size_t>(c), arm);
    for (std::size_t k = 3; k < 6; ++k) motions_[k][dof] = row[k];
  });
  for (std::size_t k = 0; k < 6; ++k) inertia_[k] = weighted_square(motions_[k]);
  MPI_Allreduce(MPI_IN_PLACE, inertia_.data(), 6, MPI_DOUBLE, MPI_SUM, system.comm);
}

std::array<double, 6> RigidMotions::participation(const double* y) const {
  std::array<double, 6> sums{};
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < motions_[k].size(); ++i) {
      sums[k] += std::sqrt(system_.lumped_mass[i]) * y[i] * motions_[k][i];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 6, MPI_DOUBLE, MPI_SUM, system_.comm);
  return sums;
}

double RigidMotions::weighted_square(const std::vector<double>& a) const {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * a[i] * system_.lumped_mass[i];
  return sum;
}

}  // namespace pounding
