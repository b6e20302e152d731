#include "system/support_shapes.h"

#include "common/matrix3.h"
#include "system/each_element.h"

namespace pounding {
namespace {

/// Displacement or rotation of a component of a node that has the motion of the support.
double rigid_displacement(const SupportColumn& column, const Mesh& mesh, LocalIndex node,
                          int component) {
  return rigid_motion_row(static_cast<std::size_t>(component),
                          minus(mesh.position(node), column.point))[column.component];
}

}  // namespace

double support_displacement(const SupportColumn& column, const Mesh& mesh, LocalIndex node,
                            int component) {
  const SupportedNode* const at = mesh.support_at(node);
  if (at == nullptr || at->support != column.support || !at->holds(component)) return 0;
  return rigid_displacement(column, mesh, node, component);
}

double ground_displacement(const SupportColumn& column, const Mesh& mesh, LocalIndex node,
                           int component) {
  if (mesh.ground_support != column.support) return 0;
  return rigid_displacement(column, mesh, node, component);
}

std::vector<double> support_force(const Structure& structure, const Mesh& mesh,
                                  const SupportColumn& column) {
  std::vector<double> force(mesh.owned_dofs, 0.0);
  std::array<double, max_element_size> moved{};
  const auto is_moved = [&](const ElementBlock& block, std::size_t element) {
    const ElementLayout layout = element_layout(block.type);
    if (!is_in_stiffness(block.type)) return false;
    bool any = false;
    const std::size_t size = layout.size();
    const std::size_t width = layout.components;
    for (std::size_t i = 0; i < size; ++i) {
      const LocalIndex node =
          block.connectivity[element * static_cast<std::size_t>(layout.nodes) + i / width];
      const auto component = static_cast<int>(i % width);
      moved[i] = support_displacement(column, mesh, node, component);
      if (layout.nodes == 1) moved[i] -= ground_displacement(column, mesh, node, component);
      any = any || moved[i] != 0;
    }
    return any;
  };
  for_each_element(structure, mesh, is_moved,
                   [&](const ElementBlock& block, std::size_t element, const ElementLayout&,
                       const stiffness::ElementWork& work) {
                     const stiffness::ElementDofs dofs(mesh, block, element);
                     const std::size_t size = dofs.size();
                     for (std::size_t i = 0; i < size; ++i) {
                       if (dofs[i] < 0 || dofs[i] >= mesh.owned_dofs) continue;
                       for (std::size_t j = 0; j < size; ++j) {
                         force[dofs[i]] += work.stiffness[i * size + j] * moved[j];
                       }
                     }
                   });
  return force;
}

void add_columns(std::span<const double> values, std::span<const double> motion, double* out,
                 std::size_t stride) {
  if (values.empty() || motion.empty()) return;
  const std::size_t width = motion.size();
  for (std::size_t k = 0; k * width < values.size(); ++k) {
    double sum = 0;
    for (std::size_t c = 0; c < width; ++c) sum += values[k * width + c] * motion[c];
    out[stride * k] += sum;
  }
}

}  // namespace pounding
