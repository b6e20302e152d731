#include "system/links.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/location.h"

namespace pounding {
namespace {

int place_of(const std::vector<LocalIndex>& dofs, LocalIndex dof) {
  return static_cast<int>(std::lower_bound(dofs.begin(), dofs.end(), dof) - dofs.begin());
}

}  // namespace

double Link::elongation(std::span<const double> field) const {
  double sum = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] >= 0) sum += (i < 3 ? -axis[i] : axis[i - 3]) * field[place[i]];
  }
  return sum;
}

std::unique_ptr<Links> Links::build(const Structure& structure, const Mesh& mesh) {
  std::unique_ptr<Links> found(new Links);
  GlobalIndex count = 0;  // of all ranks
  for (const ElementBlock& block : mesh.blocks) {
    if (!is_linear(block.type)) {
      count += block.global_count;
      for (std::size_t e = 0; e < block.count(); ++e) found->add(structure, mesh, block, e);
    }
  }
  if (count == 0) return nullptr;
  std::vector<LocalIndex>& dofs = found->dofs_;
  std::sort(dofs.begin(), dofs.end());
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  for (Link& link : found->links_) {
    for (int& place : link.place) place = place < 0 ? -1 : place_of(dofs, place);
  }
  return found;
}

/// Leaves dofs where places will stand.
void Links::add(const Structure& structure, const Mesh& mesh, const ElementBlock& block,
                std::size_t element) {
  const Region& region = structure.regions[block.region];
  const LocalIndex* nodes = &block.connectivity[2 * element];
  const Vector3 a = mesh.position(nodes[0]);
  const Vector3 b = mesh.position(nodes[1]);
  const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  Link link;
  link.number = block.tags[element];
  link.length = length;
  link.beta = structure.damping_of(region).beta;
  link.region = &region;
  bool here = false;
  bool elsewhere = false;
  for (std::size_t d = 0; d < 3; ++d) {
    link.axis[d] = (b[d] - a[d]) / length;
    for (std::size_t end = 0; end < 2; ++end) {
      const LocalIndex dof = mesh.dof(nodes[end], static_cast<int>(d));
      link.place[3 * end + d] = dof;
      here = here || (dof >= 0 && dof < mesh.owned_dofs);
      elsewhere = elsewhere || dof >= mesh.owned_dofs;
    }
  }
  if (here && elsewhere) {
    throw std::logic_error(describe_element(mesh, block, element) +
                           " is a link and lives on several ranks");
  }
  if (here) {
    std::copy_if(link.place.begin(), link.place.end(), std::back_inserter(dofs_),
                 [](int dof) { return dof >= 0; });
    links_.push_back(link);
  }
}

void Links::find_trace(const LinearSystem& system, const Mesh& mesh) {
  std::vector<TracePoint> places;
  for (LocalIndex node = 0; node < mesh.owned_nodes; ++node) {
    for (int c = 0; c < 3; ++c) {
      const LocalIndex dof = mesh.dof(node, c);
      if (dof >= 0 && std::binary_search(dofs_.begin(), dofs_.end(), dof)) {
        places.push_back({mesh.file_node[node], c});
      }
    }
  }
  trace_ = std::make_unique<Trace>(system, mesh, places, true);
}

}  // namespace pounding
