#include "system/tension_bars.h"

#include <algorithm>
#include <cmath>

namespace pounding {

std::unique_ptr<TensionBars> TensionBars::build(const Structure& structure, const Mesh& mesh) {
  std::unique_ptr<TensionBars> bars(new TensionBars);
  bars->owned_dofs_ = mesh.owned_dofs;
  std::vector<LocalIndex> ghost_dofs;
  for (const ElementBlock& block : mesh.blocks) {
    if (block.type != ElementType::tension_bar) {
      continue;
    }
    bars->count_ += block.global_count;
    const Region& region = structure.regions[static_cast<std::size_t>(block.region)];
    for (std::size_t e = 0; e < block.count(); ++e) {
      const LocalIndex* nodes = &block.connectivity[2 * e];
      const Vector3 a = mesh.position(nodes[0]);
      const Vector3 b = mesh.position(nodes[1]);
      const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      Bar bar;
      bar.stiffness = region.material.young * region.area / length;
      for (std::size_t d = 0; d < 3; ++d) {
        bar.axis[d] = (b[d] - a[d]) / length;
        for (std::size_t end = 0; end < 2; ++end) {
          const LocalIndex dof = mesh.dof(nodes[end], static_cast<int>(d));
          bar.dofs[3 * end + d] = dof;
          if (dof >= mesh.owned_dofs) {
            ghost_dofs.push_back(dof);
          }
        }
      }
      bars->bars_.push_back(bar);
    }
  }
  if (bars->count_ == 0) {
    return nullptr;
  }
  std::sort(ghost_dofs.begin(), ghost_dofs.end());
  ghost_dofs.erase(std::unique(ghost_dofs.begin(), ghost_dofs.end()), ghost_dofs.end());
  std::vector<GlobalIndex> global(ghost_dofs.size());
  for (LocalIndex node = mesh.owned_nodes; node < mesh.node_count(); ++node) {
    for (int c = 0; c < 3; ++c) {
      const auto found = std::lower_bound(ghost_dofs.begin(), ghost_dofs.end(), mesh.dof(node, c));
      if (found != ghost_dofs.end() && *found == mesh.dof(node, c)) {
        global[static_cast<std::size_t>(found - ghost_dofs.begin())] = mesh.dof_global(node, c);
      }
    }
  }
  bars->halo_ = std::make_unique<Halo>(mesh.comm, mesh.first_owned_dof, mesh.owned_dofs, global);
  for (Bar& bar : bars->bars_) {
    for (LocalIndex& dof : bar.dofs) {
      if (dof >= mesh.owned_dofs) {
        const auto found = std::lower_bound(ghost_dofs.begin(), ghost_dofs.end(), dof);
        dof = mesh.owned_dofs +
              bars->halo_->place(static_cast<std::size_t>(found - ghost_dofs.begin()));
      }
    }
  }
  return bars;
}

void TensionBars::add_force(const double* w, double* force) {
  halo_->begin(w);
  halo_->end();
  const double* const ghosts = halo_->ghosts();
  for (const Bar& bar : bars_) {
    double elongation = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const LocalIndex dof = bar.dofs[i];
      const double value = dof < 0 ? 0 : dof < owned_dofs_ ? w[dof] : ghosts[dof - owned_dofs_];
      elongation += (i < 3 ? -bar.axis[i] : bar.axis[i - 3]) * value;
    }
    const double tension = bar.stiffness * std::max(0.0, elongation);
    for (std::size_t i = 0; i < 6; ++i) {
      const LocalIndex dof = bar.dofs[i];
      if (dof >= 0 && dof < owned_dofs_) {
        force[dof] += (i < 3 ? -bar.axis[i] : bar.axis[i - 3]) * tension;
      }
    }
  }
}

}  // namespace pounding
