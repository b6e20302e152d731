#include "system/load_shapes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pounding {
namespace {

/// Loads of a structure with the forces that `fill` gives them; null if there is none.
template <typename Fill>
std::shared_ptr<const LoadShapes> make_shapes(const SceneLoads& loads, int s, Fill&& fill) {
  auto shapes = std::make_shared<LoadShapes>();
  for (std::size_t l = 0; l < loads.nodal.size(); ++l) {
    if (loads.nodal[l].structure != s) continue;
    LoadShape& shape = shapes->loads.emplace_back();
    shape.load = l;
    shape.before_start = loads.before_start[l];
    shape.total_force = loads.nodal[l].force;
    fill(loads.nodal[l], shape);
  }
  return shapes->loads.empty() ? nullptr : shapes;
}

}  // namespace

void LoadShapes::add_at_rest(std::vector<double>& force) const {
  for (const LoadShape& shape : loads) {
    for (std::size_t k = 0; k < shape.dofs.size(); ++k) {
      force[static_cast<std::size_t>(shape.dofs[k])] += shape.before_start * shape.force[k];
    }
  }
}

Vector3 LoadShapes::total_at_rest() const {
  Vector3 total{0, 0, 0};
  for (const LoadShape& shape : loads) {
    for (std::size_t d = 0; d < 3; ++d) total[d] += shape.before_start * shape.total_force[d];
  }
  return total;
}

std::shared_ptr<const LoadShapes> shape_loads(const SceneLoads& loads, int s, const Mesh& mesh) {
  return make_shapes(loads, s, [&](const NodalLoad& load, LoadShape& shape) {
    std::vector<std::pair<LocalIndex, double>> here;
    for (const NodalValue& force : load.forces) {
      const LocalIndex node = mesh.owned_node(force.node);
      const LocalIndex dof = node < 0 ? -1 : mesh.dof(node, force.component);
      if (dof >= 0) here.emplace_back(dof, force.value);
    }
    std::ranges::sort(here);
    for (const auto& [dof, value] : here) {
      shape.dofs.push_back(dof);
      shape.force.push_back(value);
    }
  });
}

std::shared_ptr<const LoadShapes> shape_reduced_loads(const SceneLoads& loads, int s,
                                                      std::span<const double> parts, bool owner) {
  const auto count = std::ranges::count(loads.nodal, s, &NodalLoad::structure);
  const std::size_t size = count == 0 ? 0 : parts.size() / static_cast<std::size_t>(count);
  std::size_t first = 0;
  return make_shapes(loads, s, [&](const NodalLoad& /*load*/, LoadShape& shape) {
    if (!owner) return;
    const std::span<const double> own = parts.subspan(first, size);
    shape.force.assign(own.begin(), own.end());
    shape.dofs.resize(size);
    std::iota(shape.dofs.begin(), shape.dofs.end(), LocalIndex{0});
    first += size;
  });
}

}  // namespace pounding
