#include "system/element_stiffness.h"

#include <mpi.h>

#include "common/parallel.h"
#include "system/element_sorter.h"

namespace pounding {
namespace {

/// Owned dofs that the first bricks leave alone.
std::vector<LocalIndex> untouched_dofs(const std::vector<BrickLines>& bricks,
                                       LocalIndex owned_dofs) {
  std::vector<char> touched(static_cast<std::size_t>(owned_dofs), 0);
  if (!bricks.empty()) bricks.front().mark_touched(touched);
  std::vector<LocalIndex> dofs;
  for (LocalIndex dof = 0; dof < owned_dofs; ++dof) {
    if (touched[static_cast<std::size_t>(dof)] == 0) dofs.push_back(dof);
  }
  return dofs;
}

}  // namespace

ElementStiffness::ElementStiffness(const Structure& structure, const Mesh& mesh,
                                   std::unique_ptr<Stiffness> assembled)
    : assembled_(std::move(assembled)) {
  std::vector<GlobalIndex> ghosts(static_cast<std::size_t>(mesh.dof_count - mesh.owned_dofs));
  for (LocalIndex node = mesh.owned_nodes; node < mesh.node_count(); ++node) {
    for (int c = 0; c < 6; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0)
        ghosts[static_cast<std::size_t>(dof - mesh.owned_dofs)] = mesh.dof_global(node, c);
    }
  }
  halo_ = std::make_unique<Halo>(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, ghosts);
  on_every_rank(mesh.comm, [&] {
    ElementSorter sorter(structure, mesh, *halo_);
    sorter.sort();
    inner_ = {sorter.brick_lines(false), sorter.congruent_elements(false)};
    outer_ = {sorter.brick_lines(true), sorter.congruent_elements(true)};
    sparse_ = std::make_unique<SparseRows>(sorter.sparse_rows());
    kinds_ = sorter.kinds();
    untouched_ = untouched_dofs(inner_.bricks, mesh.owned_dofs);
  });
  std::array<GlobalIndex, 3> counts{kinds_.bricks, kinds_.congruent, kinds_.other};
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), 3, MPI_INT64_T, MPI_SUM, mesh.comm);
  kinds_ = {counts[0], counts[1], counts[2]};
}

void ElementStiffness::apply(Vec w, Vec q) const {
  const VecReader reader(w);
  double* force = nullptr;
  POUNDING_PETSC(VecGetArrayWrite(q, &force));
  apply(reader.data(), force);
  POUNDING_PETSC(VecRestoreArrayWrite(q, &force));
}

void ElementStiffness::apply(const double* w, double* q) const {
  halo_->begin(w);
  const double* const ghosts = halo_->ghosts();
  for (const LocalIndex dof : untouched_) q[dof] = 0;
  for (std::size_t i = 0; i < inner_.bricks.size(); ++i) {
    inner_.bricks[i].apply(w, ghosts, q, i > 0);
  }
  add_congruent(inner_, w, ghosts, q);
  sparse_->add_owned(w, q);
  halo_->end();
  for (const BrickLines& bricks : outer_.bricks) bricks.apply(w, ghosts, q, true);
  add_congruent(outer_, w, ghosts, q);
  sparse_->add_ghosts(ghosts, q);
}

void ElementStiffness::add_congruent(const Part& part, const double* w, const double* ghosts,
                                     double* q) {
  for (const CongruentElements& elements : part.congruent) elements.apply(w, ghosts, q);
}

}  // namespace pounding
